#pragma once
#include "compiler/geometry/point.h"

namespace orbc::geometry {

/// An oriented geodesic as a covector: the points X with w·X_w + x·X_x + y·X_y = 0; positive to its left.
/// Normalised so that x² + y² + κw² = 1, hence the value at X is sinκ(signed distance).
struct Line {
  double w = 0, x = 0, y = 1;
};

[[nodiscard]] constexpr double value_at(const Line& line, const Ambient& v) { return line.w * v.w + line.x * v.x + line.y * v.y; }
[[nodiscard]] constexpr Line reversed(const Line& line) { return {-line.w, -line.x, -line.y}; }

/// The geodesic from P through Q. Undefined for equal or antipodal points.
[[nodiscard]] Line line_through(Space space, const Point& p, const Point& q);
/// The geodesic through P in direction V. Its left side is that of V rotated by +90°.
[[nodiscard]] Line line_along(Space space, const Point& p, const Tangent& v);
/// The unit covector nearest to `line`; H² lines with w² ≥ x² + y² do not exist and give NaN.
[[nodiscard]] Line normalised_line(Space space, const Line& line);

/// Distance of X from the line, positive to its left.
[[nodiscard]] double signed_distance(Space space, const Line& line, const Point& x);
/// Where two lines meet; on S² the intersection with the larger w. Undefined for lines that do not meet.
[[nodiscard]] Point intersection(Space space, const Line& a, const Line& b);
/// Orthogonal projection of X to the line.
[[nodiscard]] Point foot(Space space, const Line& line, const Point& x);

}  // namespace orbc::geometry
