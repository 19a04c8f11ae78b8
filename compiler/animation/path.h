#pragma once
#include <vector>

#include "compiler/base/result.h"
#include "compiler/room/room.h"
#include "compiler/scene/animation.h"

namespace orbc::animation {

/// A closed curve in the floor of a room, as a function of arc length.
/// Invariant: `length` grows by the length of each piece; the last piece ends where the first begins.
struct Path {
  /// A piece of constant speed.
  struct Piece {
    geometry::Point at;  ///< its begin
    double begin = 0;    ///< arc length of its begin
    double z = 0;        ///< height of its begin, if `has_height`
    int wall = -1;       ///< the wall (from 0) that the piece keeps its distance from; −1: a piece of a spline, a geodesic
    double foot = 0;     ///< of wall pieces: arc length on the wall of the foot of its begin
  };
  geometry::Space space = geometry::Space::euclidean;
  std::vector<Piece> pieces;
  double length = 0;
  double distance = 0;  ///< from the wall, of wall pieces
  bool has_height = false;
  std::vector<room::Wall> walls;  ///< of the room
};

/// The curve at the distance `walk.distance` from the walls, from corner to corner; it begins at corner `walk.start`.
/// Formula:     the point over the foot F of wall i is cosκ(d) F + sinκ(d) nᵢ; a foot that moves by s moves it by s·cosκ(d).
/// Diagnostics: animation.no-walk, if the room has no corners, or is not as wide everywhere as the distance asks for.
[[nodiscard]] Result<Path> wall_path(const room::Room& room, const scene::WallWalk& walk, const SourceSpan& span);

/// The closed curve through places, with one tangent at each; through places on a circle nearly that circle.
/// Formula:     pieces are cubic Bézier curves by de Casteljau's construction along geodesics. Source: Park and Ravani (1995).
/// Error:       the speed is constant to 1 %: arc length is that of kPiecesPerPlace geodesics between two places.
/// Diagnostics: those of place::locate.
[[nodiscard]] Result<Path> place_path(const room::Room& room, const scene::PlacePath& path);

/// A point of a path. In: arc length s, any number; the curve repeats.
struct PathPoint {
  geometry::Point at;
  double z = 0;  ///< if the path has heights
};
[[nodiscard]] PathPoint point_at(const Path& path, double s);

}  // namespace orbc::animation
