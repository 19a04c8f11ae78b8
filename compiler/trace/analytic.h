#pragma once
#include <vector>

#include "compiler/geometry/line.h"
#include "compiler/room/room.h"
#include "compiler/trace/ray.h"

namespace orbc::trace {

/// The prism itself: convex floor, z from 0 to height. Its border is met by formula, never through triangles.
struct Prism {
  geometry::Space space = geometry::Space::euclidean;
  double height = 1;
  std::vector<room::Wall> walls;
};

inline constexpr int kFloor = -1, kCeiling = -2;

/// Where a ray leaves the prism: a wall (from 0), kFloor or kCeiling. Ties go to the first wall; then walls before floor and ceiling.
struct Exit {
  double t = kEndless;
  int surface = kFloor;
};

/// In:      a ray that starts in the prism or on its border (rounding puts it up to 1e-15 outside; it counts as on the border).
/// Formula: wall i has the value l(s) = l_P·cosκ s + l_V·sinκ s along the ray, so cotκ of the arc to it is −l_V/l_P: the largest is met
///          first, and one inverse function serves the winner. A ray on a wall that turns outwards leaves at once (t = 0); one in a wall's
///          plane runs along it to the next wall; in a corner it leaves by each wall it points out of, in turn.
[[nodiscard]] Exit exit_of(const Prism& prism, const Ray& ray);

/// The mirror image of the ray's direction in wall `wall`: the ray starts at `at`, on the wall. Put back onto the surface of unit
/// vectors, so that errors of many bounces do not grow by themselves (H²: without it the path is lost after 20 bounces).
[[nodiscard]] Ray reflected_in_wall(const Prism& prism, const Ray& ray, double t, int wall);
/// The same at floor or ceiling.
[[nodiscard]] Ray reflected_in_plane(const Prism& prism, const Ray& ray, double t, int surface);

/// Arc length along the wall from its start to the foot of X; on S² in [0, 2π) for `*`, else in (−π, π].
[[nodiscard]] double arc_on_wall(geometry::Space space, const room::Wall& wall, const geometry::Point& x);

/// The unit normal of a wall at a point on it, into the room.
[[nodiscard]] Direction normal_of_wall(geometry::Space space, const room::Wall& wall);

}  // namespace orbc::trace
