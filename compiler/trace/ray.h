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

/// A ray of light: after the path length t it is at (X(c·t), z + m·t), X the floor's geodesic from `at` in the unit direction `along`.
/// c ≥ 0, c² + m² = 1. A vertical ray has c = 0 and any `along`. Source: design §2.
struct Ray {
  geometry::Point at;
  geometry::Tangent along;
  double z = 0;
  double c = 1, m = 0;
  double t_min = 0;       ///< surfaces of triangles up to here are not met: a ray that leaves a surface starts with kLeave
  int leaves_wall = -1;   ///< the wall (from 0) on which the ray starts and which it therefore does not meet again, or −1
};

/// How far a ray that leaves a surface of triangles goes before it can meet one; far above the residual of a hit (≤ 1e-12 in rooms).
inline constexpr double kLeave = 1e-8;
inline constexpr double kEndless = std::numeric_limits<double>::infinity();

/// The ray from a position in a direction of any length > 0. The point is put back on its surface, the direction made orthogonal to it.
[[nodiscard]] Ray ray_from(geometry::Space space, const geometry::Position& from, const Direction& direction);

/// A piece of a geodesic of the room between two positions: the shortest.
struct Segment {
  Ray ray;
  double length = 0;
};
/// In: positions whose floor points are not antipodal. Equal positions give length 0 and any direction.
[[nodiscard]] Segment segment_between(geometry::Space space, const geometry::Position& from, const geometry::Position& to);

/// Where the ray is after the path length t, and its direction of travel there.
[[nodiscard]] geometry::Position position_at(geometry::Space space, const Ray& ray, double t);
[[nodiscard]] Direction direction_at(geometry::Space space, const Ray& ray, double t);

}  // namespace orbc::trace
