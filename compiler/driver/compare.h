#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "compiler/image/image.h"
#include "compiler/mesh/mesh.h"

namespace orbc::driver {

/// How far two pictures of the same size agree. A pixel's difference is the largest of its channels, in steps of 1/255.
struct Comparison {
  std::uint64_t pixels = 0;
  std::uint64_t within_1 = 0, within_2 = 0, within_4 = 0, within_8 = 0;
  std::uint64_t beyond_on_edge = 0;   ///< differ by more than 2, at most 1 pixel from an edge of either picture
  std::uint64_t beyond_off_edge = 0;  ///< differ by more than 2 elsewhere: errors
  double mean = 0;
  int largest = 0;
};

/// An edge is a pixel that differs by more than 2/255 from its left, right, upper or lower neighbour.
/// In: pictures of equal size.
[[nodiscard]] Comparison compare(const image::Image& a, const image::Image& b);

/// Differences made visible: grey = a darkened copy of `a` where they agree within 2/255, yellow = beyond on an edge, red = beyond off the
/// edges.
[[nodiscard]] image::Image difference_picture(const image::Image& a, const image::Image& b);

/// Averages blocks of side × side pixels in linear light: a picture drawn `side` times larger becomes one of side² samples a pixel, at the
/// very points that render::sample_points names. In: width and height divisible by side.
[[nodiscard]] image::Image averaged(const image::Image& large, int side);

/// value / pixels as a share in [0, 1].
[[nodiscard]] inline double share(std::uint64_t value, const Comparison& c) {
  return c.pixels ? static_cast<double>(value) / static_cast<double>(c.pixels) : 1;
}

}  // namespace orbc::driver
