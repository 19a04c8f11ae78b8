#include "compiler/bend/screen_size.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/bend/log_map.h"
#include "compiler/geometry/circle.h"

namespace orbc::bend {

using geometry::Space;
using geometry::Vector3;

namespace {

/// The distances from the eye's foot to the points of a circle, along the rays, and the largest stretch of lengths across the rays:
/// r / |sinκ r|, which is 1 at the foot and in S² grows towards the ends of a half turn.
struct EyeDistance {
  double from = 0, to = 0, stretch = 1;
};

/// S²: the same on a sheet. In: the distances near … far on sheet 0.
EyeDistance distance_on_sheet(int sheet, double near, double far) {
  constexpr double pi = std::numbers::pi;
  far = std::min(far, pi);
  EyeDistance distance{near, far, 1};
  if (sheet % 2 == 1) distance = {pi - far, pi - near, 1};
  const double first = math::sin(distance.from), last = math::sin(distance.to);
  distance.from += sheet * pi;
  distance.to += sheet * pi;
  constexpr double kAxisSine = 1e-6, kFoot = 1e-3;
  const bool torn = !(last > kAxisSine) || (sheet > 0 && !(first > kAxisSine));
  if (torn && distance.to > kFoot) distance.stretch = kUnbounded;
  else if (sheet > 0) distance.stretch = std::max(distance.from / first, distance.to / last);
  else if (distance.to > kFoot) distance.stretch = distance.to / last;
  return distance;
}

}  // namespace

BoundingCylinder bounding_cylinder(Space space, const place::PlacedMesh& mesh) {
  BoundingCylinder cylinder;
  if (mesh.floor.empty()) return cylinder;
  const geometry::Circle circle = geometry::bounding_circle(space, mesh.floor);
  cylinder.centre = circle.centre;
  cylinder.radius = circle.radius;
  const auto [low, high] = std::minmax_element(mesh.z.begin(), mesh.z.end());
  cylinder.low = *low;
  cylinder.high = *high;
  cylinder.mesh = &mesh;
  for (const auto& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const auto a = t[k], b = t[(k + 1) % 3];
      const double length = math::hypot(geometry::distance(space, mesh.floor[a], mesh.floor[b]), mesh.z[a] - mesh.z[b]);
      cylinder.max_edge_length = std::max(cylinder.max_edge_length, length);
    }
  }
  return cylinder;
}

ScreenSize::ScreenSize(const place::Camera& eye, const BendOptions& options)
    : eye_from_room_(inverse(eye.room_from_eye)), metric_(screen_metric(eye, options)) {}

double ScreenSize::nearest_vertex(const LogMap& map, const cover::Copy& copy, const place::PlacedMesh& mesh) const {
  double near = kUnbounded;
  for (std::size_t i = 0; i < mesh.floor.size(); ++i)
    near = std::min(near, length(bent_position(map, mesh.floor[i], copy.storey.sign * mesh.z[i] + copy.storey.offset) - metric_.eye));
  return near;
}

/// An upper bound of the pixels per radian in the directions of a ball around `centre` (from the eye), as bending counts them.
double ScreenSize::max_pixels_in_ball(const Vector3& centre, double radius) const {
  const double pixels = max_pixels_per_radian(metric_), far = length(centre);
  if (!metric_.framed) return pixels;
  const double angle = math::acos(std::clamp(dot(centre, metric_.forward) / far, -1.0, 1.0)),
               half_width = radius < far ? math::asin(radius / far) : std::numbers::pi;
  const double c_border = std::max(math::cos(std::min(angle + half_width, std::numbers::pi / 2)), metric_.cos_border);
  return std::min(pixels, metric_.pixels / (c_border * c_border));
}

double ScreenSize::pixels_per_length(const cover::Copy& copy, const BoundingCylinder& cylinder, double margin) const {
  const Space space = eye_from_room_.space;
  const LogMap map{space, geometry::matrix(eye_from_room_ * copy.cover_from_room), copy.sheet};
  const geometry::Ambient c = map.eye_from_copy * cylinder.centre;
  const double away = geometry::arc_k(space, c.w, math::hypot(c.x, c.y)), radius = cylinder.radius + margin;
  const double z0 = copy.storey.sign * cylinder.low + copy.storey.offset, z1 = copy.storey.sign * cylinder.high + copy.storey.offset;
  const double low = std::min(z0, z1) - margin, high = std::max(z0, z1) + margin;
  EyeDistance distance{std::max(0.0, away - radius), away + radius, 1};
  if (space == Space::spherical) distance = distance_on_sheet(copy.sheet, distance.from, distance.to);
  if (distance.stretch == kUnbounded) return kUnbounded;
  const double rise = std::max({0.0, low - metric_.eye.z, metric_.eye.z - high});
  double near = math::hypot(distance.from, rise);
  if (cylinder.mesh && near < radius)
    near = std::max(near, nearest_vertex(map, copy, *cylinder.mesh) - distance.stretch * (cylinder.max_edge_length + margin));
  if (near < 1e-6) return kUnbounded;
  // The image lies in a ball, because the log map stretches nothing by more than `stretch`.
  const Vector3 middle = bent_position(map, cylinder.centre, (low + high) / 2) - metric_.eye;
  const double ball = math::hypot(radius * distance.stretch, (high - low) / 2), far = length(middle);
  constexpr double kFrameMargin = 0.02;
  const auto is_beyond = [&](const Vector3& n) { return dot(middle, n) > ball + kFrameMargin * (far + ball); };
  const bool offscreen = metric_.framed && std::any_of(metric_.outward.begin(), metric_.outward.end(), is_beyond);
  return max_pixels_in_ball(middle, ball) * distance.stretch / near / (offscreen ? kOffscreenFactor : 1);
}

double ScreenSize::smaller_side_px(const cover::Copy& copy, const BoundingCylinder& cylinder) const {
  const Space space = eye_from_room_.space;
  const geometry::Ambient c = geometry::matrix(eye_from_room_ * copy.cover_from_room) * cylinder.centre;
  const double sine = math::hypot(c.x, c.y),
               r = geometry::sin_k(space, std::min(cylinder.radius, space == Space::spherical ? std::numbers::pi / 2 : cylinder.radius));
  if (!(sine > r)) return kUnbounded;
  const double away = geometry::arc_k(space, c.w, sine), width = 2 * math::asin(r / sine);
  const double first = std::max(0.0, away - cylinder.radius),
               near = space == Space::spherical ? distance_on_sheet(copy.sheet, first, away + cylinder.radius).from : first;
  const double height = near > 0 ? (cylinder.high - cylinder.low) / near : kUnbounded;
  return std::min(width, height) * max_pixels_per_radian(metric_);
}

}  // namespace orbc::bend
