#include "compiler/verify/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "compiler/base/check.h"
#include "compiler/image/srgb.h"

namespace orbc::verify {
namespace {

using Mask = std::vector<std::uint8_t>;

int pixel_difference(const std::uint8_t* p, const std::uint8_t* q) {
  return std::max({std::abs(p[0] - q[0]), std::abs(p[1] - q[1]), std::abs(p[2] - q[2])});
}

/// The edges of a picture, widened by one pixel in each direction, and those that are marked already.
Mask with_edges(const image::Image& image, Mask near_edge) {
  const int w = image.width, h = image.height;
  const auto at = [&](int x, int y) {
    return image.rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x));
  };
  const auto is_edge = [&](int x, int y) {
    return (x > 0 && pixel_difference(at(x, y), at(x - 1, y)) > 2) || (x + 1 < w && pixel_difference(at(x, y), at(x + 1, y)) > 2) ||
           (y > 0 && pixel_difference(at(x, y), at(x, y - 1)) > 2) || (y + 1 < h && pixel_difference(at(x, y), at(x, y + 1)) > 2);
  };
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      if (is_edge(x, y))
        for (int v = std::max(0, y - 1); v <= std::min(h - 1, y + 1); ++v)
          for (int u = std::max(0, x - 1); u <= std::min(w - 1, x + 1); ++u)
            near_edge[static_cast<std::size_t>(v) * static_cast<std::size_t>(w) + static_cast<std::size_t>(u)] = 1;
  return near_edge;
}

Mask edges_of_either(const image::Image& a, const image::Image& b) {
  const Mask none(static_cast<std::size_t>(a.width) * static_cast<std::size_t>(a.height), 0);
  return with_edges(b, with_edges(a, none));
}

}  // namespace

Comparison compare(const image::Image& a, const image::Image& b) {
  ORBC_CHECK(a.width, ==, b.width);
  ORBC_CHECK(a.height, ==, b.height);
  const Mask near_edge = edges_of_either(a, b);
  Comparison c;
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < near_edge.size(); ++i) {
    const int d = pixel_difference(a.rgba.data() + 4 * i, b.rgba.data() + 4 * i);
    ++c.pixels;
    c.within_1 += d <= 1;
    c.within_2 += d <= 2;
    c.within_4 += d <= 4;
    c.within_8 += d <= 8;
    if (d > 2) ++(near_edge[i] ? c.beyond_on_edge : c.beyond_off_edge);
    sum += static_cast<std::uint64_t>(d);
    c.largest = std::max(c.largest, d);
  }
  c.mean = c.pixels ? static_cast<double>(sum) / static_cast<double>(c.pixels) : 0;
  return c;
}

image::Image box_downsample(const image::Image& large, int side) {
  ORBC_CHECK(large.width % side, ==, 0);
  ORBC_CHECK(large.height % side, ==, 0);
  image::Image image{large.width / side, large.height / side, {}};
  image.rgba.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 4);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      std::array<double, 3> sum{};
      for (int v = 0; v < side; ++v)
        for (int u = 0; u < side; ++u) {
          const std::size_t at =
              4 * (static_cast<std::size_t>(y * side + v) * static_cast<std::size_t>(large.width) + static_cast<std::size_t>(x * side + u));
          for (std::size_t c = 0; c < 3; ++c) sum[c] += image::decode_srgb8(large.rgba[at + c]);
        }
      for (const double channel : sum) image.rgba.push_back(image::encode_srgb8(channel / (side * side)));
      image.rgba.push_back(255);
    }
  return image;
}

image::Image difference_picture(const image::Image& a, const image::Image& b) {
  const Mask near_edge = edges_of_either(a, b);
  image::Image picture{a.width, a.height, std::vector<std::uint8_t>(a.rgba.size(), 255)};
  for (std::size_t i = 0; i < near_edge.size(); ++i) {
    const std::uint8_t* p = a.rgba.data() + 4 * i;
    std::uint8_t* out = picture.rgba.data() + 4 * i;
    const bool beyond = pixel_difference(p, b.rgba.data() + 4 * i) > 2;
    const auto grey = static_cast<std::uint8_t>((p[0] + p[1] + p[2]) / 8);
    out[0] = beyond ? 255 : grey;
    out[1] = beyond ? (near_edge[i] ? 220 : 0) : grey;
    out[2] = beyond ? 0 : grey;
  }
  return picture;
}

}  // namespace orbc::verify
