#pragma once
#include <optional>
#include <vector>

#include "compiler/bake/bake.h"
#include "compiler/bake/surface_map.h"
#include "compiler/image/image.h"

namespace orbc::bake {

/// The light of a room as it was baked, looked up where rays end.
class BakedLight {
 public:
  /// In: what was baked of a room whose first parts are those of `room`; both outlive this.
  BakedLight(const place::PlacedRoom& room, const Baked& baked);
  /// What a matte surface sends to every eye, between the texels of the atlas: colour × exposure. Nothing where no block is.
  [[nodiscard]] std::optional<scene::Color> at(const trace::SurfacePoint& point, const trace::Hit& hit) const;

 private:
  const image::Image& image_;
  SurfaceMap map_;
  std::vector<Box> boxes_;  ///< of all blocks, in the order of the parts
};

}  // namespace orbc::bake
