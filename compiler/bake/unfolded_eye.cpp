#include "compiler/bake/unfolded_eye.h"

#include <algorithm>
#include <cmath>

#include "compiler/base/elementary.h"

namespace orbc::bake {

using geometry::Position;
using trace::Direction;

UnfoldedEye unfold_eye(const cover::Copy& copy, const place::Camera& eye) {
  const geometry::Point floor = eye.room_from_eye * geometry::Point();
  return {eye.room_from_eye.space,
          {geometry::inverse(copy.cover_from_room) * floor, copy.storey.sign * (eye.z - copy.storey.offset)},
          copy.sheet};
}

light::Connection connect(const UnfoldedEye& eye, const Position& from) { return light::connect(eye.space, from, eye.at, eye.sheet); }

double max_pixels_per_unit(const UnfoldedEye& eye, const light::Connection& sight, double per_radian) {
  const double across = std::fabs(geometry::sin_k(eye.space, sight.arc));
  return per_radian * std::max(1 / std::max(sight.length, 1e-3), sight.arc / std::max(sight.length, 1e-3) / std::max(across, 1e-2));
}

double pixel_footprint(const UnfoldedEye& eye, const light::Connection& sight, const Position& at, const Direction& side,
                       double per_radian) {
  const double k = geometry::curvature(eye.space);
  const Direction normal{at.floor, 0};
  const Direction tangent = side + -k * trace::inner(eye.space, side, normal) * normal;
  const double size = std::sqrt(trace::inner(eye.space, tangent, tangent));
  if (size < 1e-12) return 0;
  const Direction along = (1 / size) * tangent, level{sight.direction.floor, 0}, flat{along.floor, 0};
  const double c = std::sqrt(std::max(0.0, trace::inner(eye.space, level, level)));
  const double ahead = c < 1e-9 ? 0 : trace::inner(eye.space, flat, level) / c;
  const double across = std::sqrt(std::max(0.0, trace::inner(eye.space, flat, flat) - ahead * ahead));
  const double stretch = sight.arc < 0.01 ? 1 : sight.arc / std::max(std::fabs(geometry::sin_k(eye.space, sight.arc)), 0.01);
  const double upright = std::max(std::fabs(ahead * sight.direction.z - along.z * c), 0.3 * math::hypot(ahead, along.z));
  return per_radian * math::hypot(across * stretch, upright) / std::max(sight.length, 1e-3);
}

std::optional<geometry::Vector3> direction_from_eye(const cover::Copy& copy, const place::Camera& camera, const Position& point) {
  const UnfoldedEye eye = unfold_eye(copy, camera);
  const light::Connection sight = light::connect(eye.space, eye.at, point, eye.sheet);
  if (!sight.valid) return std::nullopt;
  const trace::Direction floor{sight.direction.floor, 0};
  const double c = std::sqrt(std::max(0.0, trace::inner(eye.space, floor, floor)));
  const double z = copy.storey.sign * sight.direction.z;
  if (c < 1e-9) return geometry::Vector3{0, 0, z};
  const geometry::Tangent in_room = geometry::normalised_tangent(eye.space, eye.at.floor, sight.direction.floor);
  const geometry::Tangent t = geometry::inverse(camera.room_from_eye) * (copy.cover_from_room * in_room);
  return geometry::Vector3{c * t.x, c * t.y, z};
}

bool outside_frustum(const place::Camera& camera, const std::vector<geometry::Vector3>& directions) {
  if (camera.projection != scene::Projection::perspective || directions.empty()) return false;
  geometry::Vector3 middle;
  for (const auto& d : directions) middle = middle + d;
  const double size = geometry::length(middle);
  if (size < 1e-3) return false;
  const auto angle_to = [&](const geometry::Vector3& d) { return math::acos(std::clamp(geometry::dot(middle, d) / size, -1.0, 1.0)); };
  double radius = 0;
  for (const auto& d : directions) radius = std::max(radius, angle_to(d));
  const double half = math::tan(camera.fov.radians / 2);
  const double corner = math::atan(half * math::hypot(1.0, static_cast<double>(camera.height) / camera.width));
  return angle_to(camera.forward) > corner + 1.5 * radius + 0.05;
}

trace::Direction direction_to_eye(const cover::Copy& copy, const place::Camera& eye, const Position& at) {
  return connect(unfold_eye(copy, eye), at).direction;
}

}  // namespace orbc::bake
