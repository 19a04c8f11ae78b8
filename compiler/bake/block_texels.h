#pragma once
#include <algorithm>
#include <array>

#include "compiler/bake/blocks.h"
#include "compiler/image/image.h"
#include "compiler/image/srgb.h"
#include "compiler/scene/color.h"

namespace orbc::bake {

/// The diffuse light of a block, as the shared atlas shows it: linear, times the exposure; none of what is all mirror, glass or metal.
class BlockTexels {
 public:
  BlockTexels(const image::Image& image, const Box& box, bool none) : image_(image), box_(box), none_(none) {}
  [[nodiscard]] scene::Color at(double u, double v) const {
    if (none_) return {};
    const double x = u * (box_.width - 1), y = v * (box_.height - 1);
    const int i = std::min(static_cast<int>(x), box_.width - 2), j = std::min(static_cast<int>(y), box_.height - 2);
    const double s = x - i, t = y - j;
    return (1 - t) * ((1 - s) * texel(i, j) + s * texel(i + 1, j)) + t * ((1 - s) * texel(i, j + 1) + s * texel(i + 1, j + 1));
  }

 private:
  [[nodiscard]] scene::Color texel(int i, int j) const {
    const std::uint8_t* p = image_.rgba.data() + 4 * (static_cast<std::size_t>(box_.y + j) * static_cast<std::size_t>(image_.width) +
                                                      static_cast<std::size_t>(box_.x + i));
    return {image::decode_srgb8(p[0]), image::decode_srgb8(p[1]), image::decode_srgb8(p[2])};
  }
  const image::Image& image_;
  const Box& box_;
  bool none_;
};

}  // namespace orbc::bake
