#pragma once
#include <string>

#include "compiler/base/result.h"
#include "compiler/room/room.h"
#include "compiler/scene/scene.h"

namespace orbc::place {

/// The point of the floor that a place describes, in room coordinates.
/// In:           wall and corner numbers count from 1, as authors write them.
/// Makes:        a point of the closed room. A point that only rounding put outside (on a wall, in a corner) is moved into the room.
/// Exact:        containment, for the point as stored (geometry::contains).
/// Diagnostics:  place.outside-room (which wall, by how much, how far the room reaches there), place.outside-disk, place.no-such-corner,
///               place.no-such-wall, place.no-such-point (distances from two walls that no point has).
[[nodiscard]] Result<geometry::Point> locate(const scene::Place& place, const room::Room& room);

/// The same with its height: `place.z`, or `default_z` if the author gave none.
/// Diagnostics:  those of `locate`; place.outside-room when it lies under the floor or above the ceiling.
[[nodiscard]] Result<geometry::Position> locate(const scene::Place& place, const room::Room& room, double height, double default_z);

/// The distance from the room's centre to its boundary in the direction `azimuth`, in radians from +x.
[[nodiscard]] double distance_to_boundary(const room::Room& room, double azimuth);

/// The wall beyond which a point lies farthest, and how far. Measured, not exact.
struct Overhang {
  int wall = 0;         ///< from 0
  double distance = 0;  ///< ≤ 0 for points of the room
};
[[nodiscard]] Overhang overhang(const room::Room& room, const geometry::Point& x);

/// X, or a point of the closed room beside it if X lies outside by rounding only (1e-14 of its coordinates).
/// Exact: the result is in the closed room by exact predicates, or it is X.
[[nodiscard]] geometry::Point snap_into_room(const room::Room& room, const geometry::Point& x);

/// A length for messages: at most four significant digits.
[[nodiscard]] std::string to_text(double length);

}  // namespace orbc::place
