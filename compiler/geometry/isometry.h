#pragma once
#include <array>
#include <complex>

#include "compiler/geometry/line.h"
#include "compiler/geometry/point.h"

namespace orbc::geometry {

/// An isometry of the floor as a Möbius map z ↦ (az + b)/(−κ b̄ z + ā) of the chart z = (x + iy)/(1 + w), of z̄ if `reversing`.
/// |a|² + κ|b|² = 1; (a, b) and (−a, −b) are the same map. One formula for SU(2), SE(2), SU(1,1); entries grow like e^(d/2), so far
/// copies keep twice the digits of a 3×3 matrix. Names are target-from-source. Source: paper eq. 5 and 8; design §2.
struct Isometry {
  Space space = Space::euclidean;
  std::complex<double> a = 1, b = 0;
  bool reversing = false;
};

/// A 3×3 matrix on ambient vectors (w, x, y), row by row.
using Matrix3 = std::array<std::array<double, 3>, 3>;

[[nodiscard]] Isometry identity(Space space);
/// Counter-clockwise rotation about the origin.
[[nodiscard]] Isometry rotation(Space space, double radians);
/// The translation along the geodesic from the origin to P that maps the origin to P. In: P is not the antipode of the origin.
[[nodiscard]] Isometry translation_to(Space space, const Point& p);
/// The translation along the geodesic through the origin in the direction (x, y), by the length |(x, y)|.
[[nodiscard]] Isometry translation_by(Space space, double x, double y);
[[nodiscard]] Isometry reflection(Space space, const Line& line);

/// target_from_middle * middle_from_source.
[[nodiscard]] Isometry operator*(const Isometry& left, const Isometry& right);
[[nodiscard]] Isometry inverse(const Isometry& map);
/// Restores |a|² + κ|b|² = 1 by correcting the larger entry, so that products of thousands of factors stay isometries.
[[nodiscard]] Isometry renormalised(const Isometry& map);

[[nodiscard]] Point operator*(const Isometry& map, const Point& p);
[[nodiscard]] Tangent operator*(const Isometry& map, const Tangent& v);
/// The image of a line: value_at(map * line, map * X) = ± value_at(line, X). Its left side is the image of the left side of `line`.
[[nodiscard]] Line operator*(const Isometry& map, const Line& line);
/// The same map as a matrix on ambient vectors, for mapping many points.
/// Error: H²: entries grow like e^d with the distance d that the map moves the origin, so coordinates lose up to e^d ulp.
[[nodiscard]] Matrix3 matrix(const Isometry& map);
[[nodiscard]] Ambient operator*(const Matrix3& m, const Ambient& v);

/// Largest difference of the two maps' (a, b) up to the common sign; infinite when one reverses and the other does not.
[[nodiscard]] double difference(const Isometry& left, const Isometry& right);

}  // namespace orbc::geometry
