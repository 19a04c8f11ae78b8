#pragma once
#include <map>
#include <optional>
#include <vector>

#include "compiler/base/result.h"
#include "compiler/notation/orbifold.h"
#include "compiler/room/real.h"
#include "compiler/scene/scene.h"

namespace orbc::room {

/// The interior angle π/k of a corner, and its functions.
struct CornerAngle {
  Real angle, sin, cos, sin_half, cos_half;
};
[[nodiscard]] std::vector<CornerAngle> corner_angles(const std::vector<Rational>& orders);

/// A polygon in high precision: lines[i] is the unit covector of wall i (inside positive), corners[i] where wall i starts. Counts from 0.
struct Polygon {
  geometry::Space space = geometry::Space::euclidean;
  std::vector<RealVector> lines, corners;
  Real inradius = 0;  ///< 0 when no circle touches all walls
};

/// The polygon with these angles whose walls all touch one circle; its centre is the origin, corner 1 in the direction of +x.
/// In:    angles that belong to the space by Gauss–Bonnet; `scale` = inradius in E², not used elsewhere.
/// Makes: nothing when the angles close in no convex polygon (S² only: corners wider than π/2 may fail the triangle inequalities).
[[nodiscard]] std::optional<Polygon> tangential_polygon(geometry::Space space, const std::vector<CornerAngle>& angles, double scale);

/// Two half great circles that meet under the angle at ±x.
[[nodiscard]] Polygon lune(const CornerAngle& angle);
/// The rectangle with wall 1 of length side1 and wall 2 of length side2; corner 1 in the direction of +x.
[[nodiscard]] Polygon rectangle(const Real& side1, const Real& side2);

/// Completes the cuts of a decomposition: regions that the named cuts leave undivided are divided by a fan around their highest wall.
/// Without named cuts this is the paper's forward reading.
/// In:          walls count from 1; the length of cuts that are not named.
/// Makes:       N − 3 cuts for N walls, by their walls.
/// Diagnostics: room.bad-cuts.
[[nodiscard]] Result<std::vector<scene::Cut>> complete_cuts(int walls, const std::vector<scene::Cut>& named, double default_length);

/// The hyperbolic polygon with these angles whose cuts have the given lengths; not centred. A cut is a segment of the common perpendicular
/// of two walls.
/// In:          N ≥ 4 angles and the N − 3 cuts of complete_cuts.
/// Diagnostics: room.no-such-shape (only with corners wider than π/2), room.no-certificate (too wide for 50 digits).
[[nodiscard]] Result<Polygon> polygon_with_cuts(const std::vector<CornerAngle>& angles, const std::vector<scene::Cut>& cuts);

/// The hyperbolic polygon with these angles and N − 3 given side lengths (wall from 1 → length, more than 0); not centred. Nothing when
/// there is none.
[[nodiscard]] std::optional<Polygon> polygon_with_lengths(const std::vector<CornerAngle>& angles, const std::map<int, Real>& lengths);

/// The hyperbolic polygon with these angles whose side lengths are those of `shape.lengths` and obey `shape.relations`, N − 3 in all; not
/// centred.
/// In:          `tangential`, the tangential polygon with these angles.
/// Makes:       of several solutions the one that is reached from the tangential polygon when its lengths are moved straight to those that
///              are wanted.
/// Error:       relations hold to 1e-25 of the length.
/// Diagnostics: room.bad-lengths (number or value of lengths, relations in a circle), room.no-such-shape.
[[nodiscard]] Result<Polygon> polygon_with_wanted_lengths(const std::vector<CornerAngle>& angles, const scene::Shape& shape,
                                                          const Polygon& tangential);

/// H²: computes the corners from the lines. Nothing when neighbours do not meet, or a wall would run backwards.
[[nodiscard]] std::optional<Polygon> closed_polygon(std::vector<RealVector> lines);

/// H²: moves the centre to the origin and corner 1 to the direction of +x. The centre is the incentre if a circle touches all walls to
/// 1e-12, else the normalised mean of the corners.
[[nodiscard]] Polygon centred(const Polygon& polygon);

/// The length of a wall (from 0).
[[nodiscard]] Real side_length(const Polygon& polygon, std::size_t wall);

}  // namespace orbc::room
