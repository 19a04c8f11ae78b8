#include "compiler/bake/baked_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "compiler/image/image.h"
#include "compiler/image/srgb.h"

namespace orbc::bake {
namespace {

using scene::Color;

Color texel(const image::Image& image, int x, int y) {
  const std::uint8_t* p =
      image.rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
  return {image::decode_srgb8(p[0]), image::decode_srgb8(p[1]), image::decode_srgb8(p[2])};
}

}  // namespace

BakedLight::BakedLight(const place::PlacedRoom& room, const Baked& baked) : image_(baked.atlas.image), map_(room, baked.blocks) {
  for (std::size_t p = 0; p < room.parts.size(); ++p) boxes_.insert(boxes_.end(), baked.boxes[p].begin(), baked.boxes[p].end());
}

std::optional<Color> BakedLight::at(const trace::SurfacePoint& point, const trace::Hit& hit) const {
  const OnBlock on = map_.find(point, hit);
  if (on.block < 0) return std::nullopt;
  const Box& box = boxes_[static_cast<std::size_t>(on.block)];
  const double x = std::clamp(static_cast<double>(on.u), 0.0, 1.0) * (box.width - 1),
               y = std::clamp(static_cast<double>(on.v), 0.0, 1.0) * (box.height - 1);
  const int i = std::clamp(static_cast<int>(x), 0, std::max(0, box.width - 2)),
            j = std::clamp(static_cast<int>(y), 0, std::max(0, box.height - 2));
  const double s = x - i, t = y - j;
  const int right = std::min(i + 1, box.width - 1), below = std::min(j + 1, box.height - 1);
  return (1 - t) * ((1 - s) * texel(image_, box.x + i, box.y + j) + s * texel(image_, box.x + right, box.y + j)) +
         t * ((1 - s) * texel(image_, box.x + i, box.y + below) + s * texel(image_, box.x + right, box.y + below));
}

}  // namespace orbc::bake
