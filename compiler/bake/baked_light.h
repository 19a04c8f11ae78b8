#pragma once
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "compiler/bake/diffuse.h"
#include "compiler/bake/patch_locator.h"

namespace orbc::bake {

/// The diffuse light of a room, looked up in the atlas where rays end. It refers to the room and to the bake.
class BakedLight {
 public:
  /// In: a bake of a room whose first parts are those of `room`.
  BakedLight(const place::Interior& interior, const DiffuseBake& baked);
  /// What a matte surface sends to every eye: radiance × exposure, interpolated between texels. Nothing where there is no patch.
  [[nodiscard]] std::optional<scene::Color> at(const trace::SurfacePoint& point, const trace::Hit& hit) const;

 private:
  const image::Image& image_;
  PatchLocator locator_;
  std::vector<TexelRect> rects_;  ///< of all patches, in the order of the parts
  std::map<std::size_t, const std::vector<std::array<float, 3>>*> above_white_;  ///< by patch among all: its linear colours
};

}  // namespace orbc::bake
