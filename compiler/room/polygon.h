#pragma once
#include <optional>
#include <vector>

#include "compiler/base/result.h"
#include "compiler/notation/orbifold.h"
#include "compiler/room/real.h"
#include "compiler/scene/scene.h"

namespace orbc::room {

/// The interior angle π/k of a corner and what is needed of it.
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
/// side 1 × side 2, corner 1 in the direction of +x.
[[nodiscard]] Polygon rectangle(const Real& side1, const Real& side2);

/// The cuts of a decomposition, completed: regions that the named cuts leave open are fanned at their highest wall, which is the paper's
/// forward reading when nothing is named. Walls from 1.
/// Diagnostics: room.bad-cuts.
[[nodiscard]] Result<std::vector<scene::Cut>> complete_cuts(int walls, const std::vector<scene::Cut>& named, double default_length);

/// The hyperbolic polygon with these angles, glued along common perpendiculars of the given lengths; not centred.
/// In:          N ≥ 4 angles and the N − 3 cuts of complete_cuts.
/// Diagnostics: room.no-such-shape (only with corners wider than π/2), room.no-certificate (too wide for 50 digits).
[[nodiscard]] Result<Polygon> glued_polygon(const std::vector<CornerAngle>& angles, const std::vector<scene::Cut>& cuts);

/// The hyperbolic polygon with these angles and N − 3 given side lengths (wall from 1 → length); not centred.
/// Diagnostics: room.bad-lengths (number or value of the lengths), room.no-such-shape.
[[nodiscard]] Result<Polygon> polygon_with_lengths(const std::vector<CornerAngle>& angles, const std::map<int, double>& lengths);

/// Computes the corners from the lines; nothing when neighbours do not meet or a wall would run backwards. H² only.
[[nodiscard]] std::optional<Polygon> closed_polygon(std::vector<RealVector> lines);

/// Moves the polygon: incentre (if a circle touches all walls to 1e-12) or normalised mean of the corners to the origin, corner 1 to +x. H²
/// only.
[[nodiscard]] Polygon centred(const Polygon& polygon);

/// Length of wall i.
[[nodiscard]] Real side_length(const Polygon& polygon, std::size_t wall);

}  // namespace orbc::room
