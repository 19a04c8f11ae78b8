#pragma once
#include <vector>

#include "compiler/geometry/point.h"

namespace orbc::geometry {

enum class Side { right = -1, on = 0, left = 1 };
enum class Containment { outside = -1, on_border = 0, inside = 1 };

/// On which side of the geodesic from P through Q the point X lies: the sign of det(P, Q, X).
/// Exact:  for the stored doubles, without any tolerance (CGAL filtered predicates).
[[nodiscard]] Side side_of(const Ambient& p, const Ambient& q, const Ambient& x);

/// Whether X lies in the convex polygon whose border runs counter-clockwise through `outline`.
/// In:     neighbours in `outline` are neither equal nor antipodal (long walls of S² carry points between their corners).
/// Exact:  for the stored doubles.
[[nodiscard]] Containment contains(const std::vector<Point>& outline, const Point& x);

/// Whether the outline is a strictly convex, counter-clockwise, simple polygon; points between corners may lie on the line of their
/// neighbours. Exact for the stored doubles.
/// In: at least three points, all distinct, not all on one line (a hemisphere's border is one).
[[nodiscard]] bool is_convex(const std::vector<Point>& outline);

}  // namespace orbc::geometry
