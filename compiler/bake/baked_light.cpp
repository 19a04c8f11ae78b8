#include "compiler/bake/baked_light.h"

#include "compiler/bake/patch_texels.h"

namespace orbc::bake {

BakedLight::BakedLight(const place::Interior& interior, const DiffuseBake& baked)
    : image_(baked.atlas.image), locator_(interior, baked.patches) {
  for (std::size_t p = 0; p < interior.parts.size(); ++p) {
    for (const auto& [patch, texels] : baked.above_white[p]) above_white_[rects_.size() + patch] = &texels.light;
    rects_.insert(rects_.end(), baked.rects[p].begin(), baked.rects[p].end());
  }
}

std::optional<scene::Color> BakedLight::at(const trace::SurfacePoint& point, const trace::Hit& hit) const {
  const PatchUv on = locator_.find(point, hit);
  if (on.patch < 0) return std::nullopt;
  if (const auto above = above_white_.find(static_cast<std::size_t>(on.patch)); above != above_white_.end())
    return color_in_rect(*above->second, rects_[static_cast<std::size_t>(on.patch)], static_cast<double>(on.u), static_cast<double>(on.v));
  return color_in_rect(image_, rects_[static_cast<std::size_t>(on.patch)], static_cast<double>(on.u), static_cast<double>(on.v));
}

}  // namespace orbc::bake
