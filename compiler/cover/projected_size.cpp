// A copy is the room's circumscribed circle times its height; at distance d it is 2·asin(sinκ R / sinκ d) wide.
#include "compiler/cover/projected_size.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compiler/base/elementary.h"

namespace orbc::cover {

using geometry::Space;

ProjectedSize::ProjectedSize(const place::Interior& room, const place::Camera& eye)
    : space_(room.polygon.space),
      radius_(room.polygon.circumradius),
      height_(room.height),
      eye_z_(eye.z),
      pixels_(place::pixels_per_radian(eye)),
      eye_from_cover_(inverse(eye.room_from_eye)) {}

double ProjectedSize::at(double d) const {
  if (d <= radius_ || space_ == Space::spherical) return std::numeric_limits<double>::infinity();
  const double width = 2 * math::asin(std::min(1.0, geometry::sin_k(space_, radius_) / geometry::sin_k(space_, d)));
  const double height = math::atan((height_ - eye_z_) / (d - radius_)) + math::atan(eye_z_ / (d - radius_));
  return pixels_ * std::min(width, height);
}

double ProjectedSize::of(const geometry::Isometry& cover_from_room) const {
  const geometry::Ambient centre = eye_from_cover_ * cover_from_room * geometry::Point();
  return at(geometry::arc_k(space_, centre.w, math::hypot(centre.x, centre.y)));
}

}  // namespace orbc::cover
