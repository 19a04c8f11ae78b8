// A light path of S²×R, E²×R, H²×R is a geodesic of the floor at constant slope (design §2): the product metric has no mixed terms, so
// both components are geodesics of their own, at constant speeds c and m.
#include "compiler/trace/ray.h"

#include <algorithm>
#include <cmath>

#include "compiler/base/elementary.h"

namespace orbc::trace {

using geometry::Ambient;
using geometry::Position;
using geometry::Space;
using geometry::Tangent;

namespace {

/// A unit tangent at P. Vertical rays need one for their plane, and any will do.
Tangent any_tangent(Space space, const geometry::Point& p) {
  return geometry::normalised_tangent(space, p, std::fabs(p.x) <= std::fabs(p.y) ? Ambient{0, 1, 0} : Ambient{0, 0, 1});
}

}  // namespace

Ray ray_from(Space space, const Position& from, const Direction& d) {
  Ray ray;
  ray.at = geometry::normalised_point(space, from.floor);
  ray.z = from.z;
  const double horizontal = std::sqrt(std::max(0.0, inner(space, {d.floor, 0}, {d.floor, 0})));
  const double square = horizontal * horizontal + d.z * d.z;
  const double length = square > 1e-200 && square < 1e200 ? std::sqrt(square) : math::hypot(horizontal, d.z);
  if (horizontal < 1e-150 * length || horizontal == 0) {
    ray.along = any_tangent(space, ray.at);
    ray.c = 0;
    ray.m = d.z < 0 ? -1 : 1;
    return ray;
  }
  ray.along = geometry::normalised_tangent(space, ray.at, (1 / horizontal) * d.floor);
  ray.c = horizontal / length;
  ray.m = d.z / length;
  return ray;
}

Segment segment_between(Space space, const Position& from, const Position& to) {
  const double s = geometry::distance(space, from.floor, to.floor);
  const double dz = to.z - from.z;
  Segment segment;
  segment.length = math::hypot(s, dz);
  segment.ray.at = from.floor;
  segment.ray.z = from.z;
  if (s < 1e-15) {
    segment.ray.along = any_tangent(space, from.floor);
    segment.ray.c = 0;
    segment.ray.m = dz < 0 ? -1 : 1;
    return segment;
  }
  segment.ray.along = geometry::direction_to(space, from.floor, to.floor);
  segment.ray.c = s / segment.length;
  segment.ray.m = dz / segment.length;
  return segment;
}

Position position_at(Space space, const Ray& ray, double t) {
  return {geometry::point_along(space, ray.at, ray.along, ray.c * t), ray.z + ray.m * t};
}

Direction direction_at(Space space, const Ray& ray, double t) {
  const Tangent v = geometry::direction_along(space, ray.at, ray.along, ray.c * t);
  return {ray.c * v, ray.m};
}

}  // namespace orbc::trace
