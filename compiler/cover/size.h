#pragma once
#include "compiler/geometry/isometry.h"
#include "compiler/place/eye.h"
#include "compiler/place/placed.h"
#include "compiler/scene/scene.h"

namespace orbc::cover {

/// How large the copies of a room are in the picture, as `min_pixels` takes it: the smaller extent, in pixels of its middle, of the upright
/// cylinder around the room. It depends on how far away a copy is, and on nothing else: not on how much of it a mirror lets through. On S²,
/// where nothing becomes small, and around the eye it is large.
class CopySize {
 public:
  CopySize(const place::PlacedRoom& room, const place::Eye& eye);
  /// In: arc length on the floor from the eye to the centre of the copy. Falls with the distance.
  [[nodiscard]] double at(double distance) const;
  [[nodiscard]] double of(const geometry::Isometry& cover_from_room) const;

 private:
  geometry::Space space_;
  double radius_, height_, eye_z_, pixels_;
  geometry::Isometry eye_from_cover_;
};

/// Whether a copy of that size is left out. `slack`: two roads to one copy differ by rounding; who closes the hole where copies are left
/// out counts those as well that are just large enough.
[[nodiscard]] inline bool too_small(double size, const scene::CoverSpec& spec, double slack = 0) {
  return size < spec.min_pixels * (1 + slack);
}

}  // namespace orbc::cover
