#pragma once
#include "compiler/geometry/isometry.h"
#include "compiler/place/camera.h"
#include "compiler/place/interior.h"
#include "compiler/scene/scene.h"

namespace orbc::cover {

/// The size of a copy in the picture, in pixels of its centre: the smaller of width and height of the upright cylinder around the room. It
/// depends on the distance of the copy only. It is infinite on S², where nothing becomes small, and around the eye.
class ProjectedSize {
 public:
  ProjectedSize(const place::Interior& room, const place::Camera& eye);
  /// In: arc length on the floor from the eye to the centre of the copy. Falls with the distance.
  [[nodiscard]] double at(double distance) const;
  [[nodiscard]] double of(const geometry::Isometry& cover_from_room) const;

 private:
  geometry::Space space_;
  double radius_, height_, eye_z_, pixels_;
  geometry::Isometry eye_from_cover_;
};

/// Whether a copy of that size is left out.
/// In: a relative slack. Two paths to one copy give sizes that differ by rounding; code that closes the hole of copies that are left out
///     uses a slack, to include copies at the limit.
[[nodiscard]] inline bool is_culled(double size, const scene::CoverSpec& spec, double slack = 0) {
  return size < spec.min_pixels * (1 + slack);
}

}  // namespace orbc::cover
