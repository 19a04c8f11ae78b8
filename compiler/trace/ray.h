#pragma once
#include <limits>

#include "compiler/geometry/point.h"

namespace orbc::trace {

/// A tangent vector of the room: its floor part (ambient, orthogonal to the point it stands at) and its height part. Of a unit vector
/// x² + y² + κw² + z² = 1.
struct Direction {
  geometry::Ambient floor{0, 0, 0};
  double z = 0;
};
[[nodiscard]] constexpr Direction operator-(const Direction& d) { return {{-d.floor.w, -d.floor.x, -d.floor.y}, -d.z}; }
[[nodiscard]] constexpr Direction operator+(const Direction& a, const Direction& b) { return {a.floor + b.floor, a.z + b.z}; }
[[nodiscard]] constexpr Direction operator*(double s, const Direction& d) { return {s * d.floor, s * d.z}; }
/// The inner product of the product geometry, for two vectors at the same point.
[[nodiscard]] constexpr double inner(geometry::Space space, const Direction& a, const Direction& b) {
  return a.floor.x * b.floor.x + a.floor.y * b.floor.y + geometry::curvature(space) * a.floor.w * b.floor.w + a.z * b.z;
}

/// A ray: after the path length t it is at (X(c·t), z + m·t), where X is the floor's geodesic from `at` in the unit direction `along`.
/// c ≥ 0 and c² + m² = 1. A vertical ray has c = 0 and any `along`. Source: design §2.
struct Ray {
  geometry::Point at;
  geometry::Tangent along;
  double z = 0;
  double c = 1, m = 0;
  double t_min = 0;     ///< triangles up to this path length are ignored; rays that start on a triangle set it to kRayEpsilon
  int start_wall = -1;  ///< the wall (from 0) on which the ray starts and which it therefore cannot hit first; −1: none
};

/// Offset of rays that start on a triangle: hits nearer than this are ignored. It is far above the residual of a hit (≤ 1e-12 in rooms).
inline constexpr double kRayEpsilon = 1e-8;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The ray from a position in a direction of any length > 0. The start is projected onto the space, the direction onto its tangent plane.
[[nodiscard]] Ray ray_from(geometry::Space space, const geometry::Position& from, const Direction& direction);

/// The shortest geodesic between two positions.
struct Segment {
  Ray ray;
  double length = 0;
};
/// In: positions whose floor points are not antipodal. Equal positions give length 0 and an arbitrary direction.
[[nodiscard]] Segment segment_between(geometry::Space space, const geometry::Position& from, const geometry::Position& to);

/// The ray's position after the path length t, and its unit direction of travel there.
[[nodiscard]] geometry::Position position_at(geometry::Space space, const Ray& ray, double t);
[[nodiscard]] Direction direction_at(geometry::Space space, const Ray& ray, double t);

}  // namespace orbc::trace
