#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "compiler/image/image.h"

namespace orbc::verify {

/// How far two pictures of the same size agree. A pixel's difference is the largest of its channels, in steps of 1/255.
struct Comparison {
  std::uint64_t pixels = 0;
  std::uint64_t within_1 = 0, within_2 = 0, within_4 = 0, within_8 = 0;
  std::uint64_t beyond_on_edge = 0;   ///< differ by more than 2, at most 1 pixel from an edge of either picture
  std::uint64_t beyond_off_edge = 0;  ///< differ by more than 2 elsewhere: errors
  double mean = 0;
  int largest = 0;
};

/// Compares two pictures of the same size. An edge is a pixel that differs by more than 2/255 from its left, right, upper or lower
/// neighbour.
[[nodiscard]] Comparison compare(const image::Image& a, const image::Image& b);

/// A picture of the differences: a dark grey copy of `a` where the two agree within 2/255, yellow where they differ on an edge, red where
/// they differ elsewhere. In: pictures of the same size.
[[nodiscard]] image::Image difference_picture(const image::Image& a, const image::Image& b);

/// Averages squares of side × side pixels in linear light. A picture drawn `side` times larger becomes one with side² samples a pixel, at
/// the points of render::sample_points. In: width and height are divisible by side.
[[nodiscard]] image::Image box_downsample(const image::Image& large, int side);

/// value / pixels, in [0, 1].
[[nodiscard]] inline double share(std::uint64_t value, const Comparison& c) {
  return c.pixels ? static_cast<double>(value) / static_cast<double>(c.pixels) : 1;
}

}  // namespace orbc::verify
