#include "compiler/bend/detail.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/bend/log_map.h"

namespace orbc::bend {

using geometry::Space;
using geometry::Vector3;

namespace {

/// Path lengths on the floor to a circle whose points are at distances near … far from the eye's foot, and by how much lengths across the
/// way are stretched there at most: r / |sin r| grows towards the ends of a half turn (and is 1 at the eye's own foot).
struct Way {
  double from = 0, to = 0, stretch = 1;
};

Way way_on(int sheet, double near, double far) {
  constexpr double pi = std::numbers::pi;
  far = std::min(far, pi);
  Way way{near, far, 1};
  if (sheet % 2 == 1) way = {pi - far, pi - near, 1};
  const double first = math::sin(way.from), last = math::sin(way.to);
  way.from += sheet * pi, way.to += sheet * pi;
  const bool torn = !(last > 1e-6) || (sheet > 0 && !(first > 1e-6));
  if (torn && way.to > 1e-3) way.stretch = kCannotTell;
  else if (sheet > 0) way.stretch = std::max(way.from / first, way.to / last);
  else if (way.to > 1e-3) way.stretch = way.to / last;
  return way;
}

}  // namespace

Extent extent_of(Space space, const place::PlacedMesh& mesh) {
  Extent extent;
  if (mesh.floor.empty()) return extent;
  geometry::Ambient sum{0, 0, 0};
  extent.low = extent.high = mesh.z[0];
  for (std::size_t i = 0; i < mesh.floor.size(); ++i) {
    sum = sum + mesh.floor[i];
    extent.low = std::min(extent.low, mesh.z[i]);
    extent.high = std::max(extent.high, mesh.z[i]);
  }
  if (space != Space::spherical || sum.w * sum.w + sum.x * sum.x + sum.y * sum.y > 1e-6)
    extent.centre = geometry::normalised_point(space, sum);
  for (const auto& p : mesh.floor) extent.radius = std::max(extent.radius, geometry::distance(space, extent.centre, p));
  extent.mesh = &mesh;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const auto a = t[k], b = t[(k + 1) % 3];
      extent.longest =
          std::max(extent.longest, math::hypot(geometry::distance(space, mesh.floor[a], mesh.floor[b]), mesh.z[a] - mesh.z[b]));
    }
  return extent;
}

Detail::Detail(const place::Eye& eye, const BendOptions& options)
    : eye_from_room_(inverse(eye.room_from_eye)), sight_(sight_of(eye, options)) {}

double Detail::nearest_vertex(const LogMap& map, const cover::Copy& copy, const Extent& extent) const {
  double near = kCannotTell;
  const place::PlacedMesh& mesh = *extent.mesh;
  for (std::size_t i = 0; i < mesh.floor.size(); ++i)
    near = std::min(near, length(bent_position(map, mesh.floor[i], copy.storey.sign * mesh.z[i] + copy.storey.offset) - sight_.eye));
  return near;
}

double Detail::pixels_per_length(const cover::Copy& copy, const Extent& extent, double margin) const {
  const Space space = eye_from_room_.space;
  const LogMap map{space, geometry::matrix(eye_from_room_ * copy.cover_from_room), copy.sheet};
  const geometry::Ambient c = map.eye_from_copy * extent.centre;
  const double away = geometry::arc_k(space, c.w, math::hypot(c.x, c.y)), radius = extent.radius + margin;
  const double z0 = copy.storey.sign * extent.low + copy.storey.offset, z1 = copy.storey.sign * extent.high + copy.storey.offset;
  const double low = std::min(z0, z1) - margin, high = std::max(z0, z1) + margin;
  Way way{std::max(0.0, away - radius), away + radius, 1};
  if (space == Space::spherical) way = way_on(copy.sheet, way.from, way.to);
  if (way.stretch == kCannotTell) return kCannotTell;
  const double level = std::max({0.0, low - sight_.eye.z, sight_.eye.z - high});
  double near = math::hypot(way.from, level);
  if (extent.mesh && near < radius) near = std::max(near, nearest_vertex(map, copy, extent) - way.stretch * (extent.longest + margin));
  if (near < 1e-6) return kCannotTell;
  // The image lies in a ball: the log map stretches nothing by more than that.
  const Vector3 middle = bent_position(map, extent.centre, (low + high) / 2) - sight_.eye;
  const double ball = math::hypot(radius * way.stretch, (high - low) / 2), far = length(middle);
  double pixels = densest(sight_), coarser = 1;
  if (sight_.framed) {
    const double angle = math::acos(std::clamp(dot(middle, sight_.forward) / far, -1.0, 1.0)),
                 wide = ball < far ? math::asin(ball / far) : std::numbers::pi;
    const double c_border = std::max(math::cos(std::min(angle + wide, std::numbers::pi / 2)), sight_.cos_border);
    pixels = std::min(pixels, sight_.pixels / (c_border * c_border));
    for (const Vector3& n : sight_.outward)
      if (dot(middle, n) > ball + 0.02 * (far + ball)) coarser = kOutside;
  }
  return pixels * way.stretch / near / coarser;
}

double Detail::smaller_side_px(const cover::Copy& copy, const Extent& extent) const {
  const Space space = eye_from_room_.space;
  const geometry::Ambient c = geometry::matrix(eye_from_room_ * copy.cover_from_room) * extent.centre;
  const double sine = math::hypot(c.x, c.y),
               r = geometry::sin_k(space, std::min(extent.radius, space == Space::spherical ? std::numbers::pi / 2 : extent.radius));
  if (!(sine > r)) return kCannotTell;
  const double away = geometry::arc_k(space, c.w, sine), wide = 2 * math::asin(r / sine);
  const double first = std::max(0.0, away - extent.radius),
               near = space == Space::spherical ? way_on(copy.sheet, first, away + extent.radius).from : first;
  const double tall = near > 0 ? (extent.high - extent.low) / near : kCannotTell;
  return std::min(wide, tall) * densest(sight_);
}

}  // namespace orbc::bend
