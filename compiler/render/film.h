#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "compiler/image/image.h"
#include "compiler/mesh/mesh.h"
#include "compiler/scene/color.h"

namespace orbc::render {

/// The reference picture: one value per pixel and pass, rows from top to bottom. Passes other than colour are those of the pixel's first
/// sample.
struct Film {
  int width = 0, height = 0;
  std::vector<scene::Color> color;           ///< linear radiance, averaged over the samples, without an upper bound
  std::vector<scene::Color> shown;           ///< the same where samples above white are cut off before; empty: as `color`
  std::vector<float> depth;                  ///< length of the path to the surface, infinite where there is none
  std::vector<std::array<float, 3>> normal;  ///< of the surface, in the frame of the room
  std::vector<std::int32_t> object;          ///< index of the part; −1: a wall without panel; −2: the background
  std::vector<std::int32_t> bounces;
  std::vector<float> error;   ///< standard error of the colour's noisiest channel (`integrator: path`), else empty
  std::vector<float> weight;  ///< largest channel of the mirrors' throughput
};

[[nodiscard]] Film make_film(int width, int height);

/// The colour pass as 8-bit sRGB: round(255·encode(exposure·radiance)), cut off at white; there is no tone curve.
[[nodiscard]] image::Image to_image(const Film& film, double exposure = 1);

/// The share of pixels in which a channel is above white, and so cut off in pictures of 8 bits.
[[nodiscard]] double clipped_share(const Film& film, double exposure);

enum class Pass { color, depth, normal, object, bounces, weight };
/// A pass as a picture: depth and bounces as greys (near is light), normals as (n + 1)/2, objects in distinct colours.
[[nodiscard]] image::Image to_image(const Film& film, Pass pass, double exposure);

/// All passes as channels of OpenEXR: R G B (linear), Z, N.X N.Y N.Z, object.id, bounces, weight.
[[nodiscard]] image::FloatImage to_float_image(const Film& film);

}  // namespace orbc::render
