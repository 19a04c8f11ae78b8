#pragma once
#include <vector>

#include "compiler/geometry/line.h"
#include "compiler/room/room.h"
#include "compiler/trace/ray.h"

namespace orbc::trace {

/// The room's own surfaces: a prism over a convex polygon, z from 0 to `height`. Rays meet them by formula, never through triangles.
struct Prism {
  geometry::Space space = geometry::Space::euclidean;
  double height = 1;
  std::vector<room::Wall> walls;
};

inline constexpr int kFloor = -1, kCeiling = -2;

/// Where a ray leaves the prism: a wall (from 0), kFloor or kCeiling. Of equal path lengths the first wall wins, and walls win over floor
/// and ceiling.
struct Exit {
  double t = kInfinity;
  int surface = kFloor;
  double cot_arc = 0;  ///< of a wall: cotκ of the floor arc to it, which may be infinite
};

/// In:      a ray that starts in the prism or on its border. A start up to 1e-15 outside counts as on the border.
/// Formula: wall i has the value l(s) = l_P·cosκ s + l_V·sinκ s along the ray, so cotκ of the arc to it is −l_V/l_P. The wall with
///          the largest cotκ is hit first, so the inverse function is computed once. A ray that starts on a wall and points outwards leaves
///          at t = 0. A ray in the plane of a wall runs along it to the next wall. In a corner the ray leaves by each wall that it points
///          out of, one after the other.
/// In:      `within`: what lies beyond this path length need not be told apart. If the ray surely stays inside so long, t may be infinite.
[[nodiscard]] Exit exit_of(const Prism& prism, const Ray& ray, double within = kInfinity);

/// The ray that continues from path length t, reflected in wall `wall`; it starts on the wall. Point and direction are projected back onto
/// the space, so that errors do not accumulate over bounces (without this, paths in H² are lost after 20 bounces).
[[nodiscard]] Ray reflected_in_wall(const Prism& prism, const Ray& ray, double t, int wall);
/// The same where exit_of found a wall; cotκ of the arc saves an exponential, or a sine and a cosine.
[[nodiscard]] Ray reflected_in_wall(const Prism& prism, const Ray& ray, const Exit& exit);
/// The same at the floor or ceiling (`surface` is kFloor or kCeiling).
[[nodiscard]] Ray reflected_in_plane(const Prism& prism, const Ray& ray, double t, int surface);

/// Arc length along the wall's line from the wall's start to the foot of the perpendicular from X; on S² in [0, 2π) for the one wall of
/// `*`, else in (−π, π].
[[nodiscard]] double arc_on_wall(geometry::Space space, const room::Wall& wall, const geometry::Point& x);
/// Its tanκ. In: E² or H².
[[nodiscard]] double tan_on_wall(geometry::Space space, const room::Wall& wall, const geometry::Point& x);

/// The unit normal of a wall, pointing into the room; the same at each of its points.
[[nodiscard]] Direction normal_of_wall(geometry::Space space, const room::Wall& wall);

}  // namespace orbc::trace
