#pragma once
#include <cmath>

#include "compiler/base/elementary.h"
#include "compiler/geometry/point.h"
#include "compiler/trace/ray.h"

namespace orbc::surface {

/// An orthonormal frame (e1, e2, up) of the room's tangent space at a point, right-handed. In it vectors are Euclidean.
struct TangentFrame {
  geometry::Point at;
  geometry::Ambient e1, e2;  ///< unit tangent vectors of the floor
};

/// A frame at a point of the floor. Which frame is a function of the point alone.
[[nodiscard]] inline TangentFrame tangent_frame(geometry::Space space, const geometry::Point& at) {
  const double k = geometry::curvature(space);
  const geometry::Tangent e1 =
      geometry::normalised_tangent(space, at, std::fabs(at.x) <= std::fabs(at.y) ? geometry::Ambient{0, 1, 0} : geometry::Ambient{0, 0, 1});
  const geometry::Ambient left{at.x * e1.y - at.y * e1.x, at.y * e1.w - at.w * e1.y, at.w * e1.x - at.x * e1.w};
  return {at, e1, {k * left.w, left.x, left.y}};
}

/// The inner product of the ambient space: the component of v along the unit tangent vector e.
[[nodiscard]] inline double tangent_component(geometry::Space space, const geometry::Ambient& e, const geometry::Ambient& v) {
  return geometry::curvature(space) * e.w * v.w + e.x * v.x + e.y * v.y;
}
/// The components of an ambient vector in a frame. The part of it that is normal to the space is dropped.
[[nodiscard]] inline geometry::Vector3 to_local(geometry::Space space, const TangentFrame& frame, const trace::Direction& d) {
  return {tangent_component(space, frame.e1, d.floor), tangent_component(space, frame.e2, d.floor), d.z};
}
/// The ambient vector with these components in a frame.
[[nodiscard]] inline trace::Direction to_ambient(const TangentFrame& frame, const geometry::Vector3& v) {
  return {v.x * frame.e1 + v.y * frame.e2, v.z};
}

/// The exponential map of the product geometry: the end of the geodesic with the initial vector v, as long as v. In: v in `frame`.
[[nodiscard]] inline geometry::Position exponential(geometry::Space space, const geometry::Position& from, const TangentFrame& frame,
                                                    const geometry::Vector3& v) {
  const double s = math::hypot(v.x, v.y);
  if (s < 1e-300) return {from.floor, from.z + v.z};
  const geometry::Ambient d = (v.x / s) * frame.e1 + (v.y / s) * frame.e2;
  return {geometry::point_along(space, from.floor, geometry::Tangent(d.w, d.x, d.y), s), from.z + v.z};
}

}  // namespace orbc::surface
