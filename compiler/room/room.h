#pragma once
#include <vector>

#include "compiler/geometry/isometry.h"
#include "compiler/geometry/line.h"
#include "compiler/geometry/point.h"
#include "compiler/notation/orbifold.h"

namespace orbc::room {

struct Corner {
  geometry::Point at;
  double angle = 0;                 ///< interior angle in radians, π/k
};

/// Wall i joins corner i to corner i+1 (of `*`: the whole equator). Inside is to the left of `line`.
struct Wall {
  geometry::Line line;
  geometry::Point start;            ///< arc length 0 of the wall
  geometry::Tangent along;          ///< direction of the wall at `start`
  double length = 0;
  bool reflects = true;  ///< its reflection belongs to the group; false for the plain end walls of strips only
};

/// What is proven of a realised room from its stored doubles alone: exact signs, and upper bounds of residuals. In H² the ulp of a double
/// moves a point at distance r from the origin by e^(2r) ulps, so the residuals of wide rooms are those of the number format.
struct Certificate {
  bool convex = false;              ///< exact signs of the stored ambient vectors
  double angle_residual = 0;        ///< upper bound of |angle − π/k| over all corners, by interval arithmetic
  double closure_residual = 0;      ///< upper bound of the distance of a stored corner from the lines of its walls
  double side_residual = 0;         ///< upper bound of |Wall::length − distance of the stored corners|
  double area_residual = 0;         ///< |area by Gauss–Bonnet of χ − area of the stored polygon|
};

/// The realised polygon of an orbifold: the floor of a mirror room. Its centre (the incentre if it has one, else the normalised mean of the
/// corners) is the origin; corner 1 lies in the direction of +x; corners run counter-clockwise. Strips are rectangles with four corners
/// π/2: of `**` walls 1 and 3 are mirrors, 2 and 4 plain ends; of `*22∞` only wall 3 is a plain end. Lengths are in curvature radii (E²:
/// scene units).
struct Room {
  geometry::Space space = geometry::Space::euclidean;
  notation::Orbifold orbifold;
  std::vector<Corner> corners;      ///< `*`: none
  std::vector<Wall> walls;
  /// The border for exact predicates: the corners and, on long walls of S², points between them, so that neighbours are never antipodal
  std::vector<geometry::Point> outline;
  std::vector<int> outline_wall;    ///< outline[i] → outline[i+1] lies in wall outline_wall[i] (from 0)
  double inradius = 0;              ///< 0 when there is no inscribed circle
  double circumradius = 0;          ///< largest distance of a point of the room from the origin
  double area = 0;
  Certificate certificate;
};

/// The point of wall `wall` (from 0) at arc length s from its start.
[[nodiscard]] geometry::Point point_on_wall(const Room& room, int wall, double s);
/// The reflection in wall `wall` (from 0).
[[nodiscard]] geometry::Isometry reflection_in_wall(const Room& room, int wall);

/// The reflections in all walls that reflect, in the order of the walls. They generate the group of the room.
[[nodiscard]] std::vector<geometry::Isometry> generators(const Room& room);

}  // namespace orbc::room
