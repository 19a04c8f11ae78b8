#pragma once
#include <string>

#include "compiler/base/result.h"
#include "compiler/room/room.h"
#include "compiler/scene/scene.h"

namespace orbc::place {

/// The point of the floor that a place names, in room coordinates.
/// In:           wall and corner numbers count from 1, as authors write them.
/// Makes:        a point of the closed room: one that rounding alone put outside (on a wall, in a corner) is rounded into the room.
/// Exact:        containment, for the point as stored (geometry::contains).
/// Diagnostics:  place.outside-room (which wall, by how much, how far the room reaches there), place.outside-disk, place.no-such-corner,
///               place.no-such-wall, place.no-such-point (distances from two walls that no point has).
[[nodiscard]] Result<geometry::Point> locate(const scene::Place& place, const room::Room& room);

/// The same with its height: `place.z`, or `default_z` where the author gave none.
/// Diagnostics:  those of `locate`; place.outside-room when it lies under the floor or above the ceiling.
[[nodiscard]] Result<geometry::Position> locate(const scene::Place& place, const room::Room& room, double height, double default_z);

/// How far the room reaches from its centre in the direction (cos azimuth, sin azimuth).
[[nodiscard]] double reach(const room::Room& room, double azimuth);

/// The wall (from 0) beyond which X lies farthest, and by how much (≤ 0 inside). Measured, not exact.
struct Overhang {
  int wall = 0;
  double distance = 0;
};
[[nodiscard]] Overhang overhang(const room::Room& room, const geometry::Point& x);

/// X, or, if only rounding (1e-14 of its coordinates) put it outside, a point beside it that lies in the closed room.
/// Exact: what comes back is inside or on the border by exact predicates, or is X.
[[nodiscard]] geometry::Point rounded_into(const room::Room& room, const geometry::Point& x);

/// A length as a message shows it: at most four significant digits.
[[nodiscard]] std::string to_text(double length);

}  // namespace orbc::place
