#pragma once
#include <cmath>

#include "compiler/base/elementary.h"
#include "compiler/geometry/point.h"
#include "compiler/trace/ray.h"

namespace orbc::surface {

/// An orthonormal frame of the floor at a point, right-handed with z up: tangent vectors of the room as ordinary ones.
struct Frame {
  geometry::Point at;
  geometry::Ambient e1, e2;
};

[[nodiscard]] inline Frame frame_at(geometry::Space space, const geometry::Point& at) {
  const double k = geometry::curvature(space);
  const geometry::Tangent e1 =
      geometry::normalised_tangent(space, at, std::fabs(at.x) <= std::fabs(at.y) ? geometry::Ambient{0, 1, 0} : geometry::Ambient{0, 0, 1});
  const geometry::Ambient left{at.x * e1.y - at.y * e1.x, at.y * e1.w - at.w * e1.y, at.w * e1.x - at.x * e1.w};
  return {at, e1, {k * left.w, left.x, left.y}};
}

[[nodiscard]] inline double component(geometry::Space space, const geometry::Ambient& e, const geometry::Ambient& v) {
  return geometry::curvature(space) * e.w * v.w + e.x * v.x + e.y * v.y;
}
/// The components of a vector; what of it points out of the surface is left out.
[[nodiscard]] inline geometry::Vector3 local(geometry::Space space, const Frame& frame, const trace::Direction& d) {
  return {component(space, frame.e1, d.floor), component(space, frame.e2, d.floor), d.z};
}
[[nodiscard]] inline trace::Direction global(const Frame& frame, const geometry::Vector3& v) {
  return {v.x * frame.e1 + v.y * frame.e2, v.z};
}

/// The position that a vector at `from` leads to: the exponential map of the product geometry.
[[nodiscard]] inline geometry::Position exponential(geometry::Space space, const geometry::Position& from, const Frame& frame,
                                                    const geometry::Vector3& v) {
  const double s = math::hypot(v.x, v.y);
  if (s < 1e-300) return {from.floor, from.z + v.z};
  const geometry::Ambient d = (v.x / s) * frame.e1 + (v.y / s) * frame.e2;
  return {geometry::point_along(space, from.floor, geometry::Tangent(d.w, d.x, d.y), s), from.z + v.z};
}

}  // namespace orbc::surface
