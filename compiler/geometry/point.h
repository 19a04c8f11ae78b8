#pragma once
#include <complex>

#include "compiler/geometry/space.h"

namespace orbc::geometry {

/// A vector of the ambient 3-space of the floor: (w, x, y) with the form w² + κ(x² + y²).
struct Ambient {
  double w = 0, x = 0, y = 0;
};
[[nodiscard]] constexpr Ambient operator+(const Ambient& a, const Ambient& b) { return {a.w + b.w, a.x + b.x, a.y + b.y}; }
[[nodiscard]] constexpr Ambient operator-(const Ambient& a, const Ambient& b) { return {a.w - b.w, a.x - b.x, a.y - b.y}; }
[[nodiscard]] constexpr Ambient operator*(double s, const Ambient& a) { return {s * a.w, s * a.x, s * a.y}; }

/// A point of the floor: an ambient vector with w² + κ(x² + y²) = 1 (unit sphere | plane w = 1 | upper sheet).
struct Point : Ambient {
  constexpr Point() : Ambient{1, 0, 0} {}
  constexpr Point(double w_, double x_, double y_) : Ambient{w_, x_, y_} {}
};

/// A unit tangent of the floor at some point P: x² + y² + κ w² = 1, and P_w V_w + κ(P_x V_x + P_y V_y) = 0 (E²: V_w = 0).
struct Tangent : Ambient {
  constexpr Tangent() : Ambient{0, 1, 0} {}
  constexpr Tangent(double w_, double x_, double y_) : Ambient{w_, x_, y_} {}
};

/// A point of the room: its foot on the floor, and its height above it.
struct Position {
  Point floor;
  double z = 0;
};

/// A vector of the tangent space of the eye (right-handed, z up), the coordinates of bent meshes and cameras.
struct Vector3 {
  double x = 0, y = 0, z = 0;
};
[[nodiscard]] constexpr Vector3 operator+(const Vector3& a, const Vector3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
[[nodiscard]] constexpr Vector3 operator-(const Vector3& a, const Vector3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
[[nodiscard]] constexpr Vector3 operator*(double s, const Vector3& a) { return {s * a.x, s * a.y, s * a.z}; }
[[nodiscard]] constexpr double dot(const Vector3& a, const Vector3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
[[nodiscard]] constexpr Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] inline double length(const Vector3& a) { return std::sqrt(dot(a, a)); }
[[nodiscard]] inline Vector3 normalised(const Vector3& a) { return (1 / length(a)) * a; }

/// The ambient vector scaled back onto the surface. Undefined for vectors that are not time-like (H²) or have w = 0 (E²).
[[nodiscard]] Point normalised_point(Space space, const Ambient& vector);
/// The unit tangent at P nearest to `vector`. Removes the rounding errors that accumulate along a path of many segments.
[[nodiscard]] Tangent normalised_tangent(Space space, const Point& at, const Ambient& vector);

/// Intrinsic distance. Error: a few ulp of the stored coordinates; in H² absolute error grows like e^r with the distance r of the points
/// from the origin.
[[nodiscard]] double distance(Space space, const Point& p, const Point& q);

/// The point reached after arc length s from P in the unit direction V: cosκ(s)·P + sinκ(s)·V. Source: design §2.
[[nodiscard]] Point point_along(Space space, const Point& p, const Tangent& v, double s);
/// The direction of travel there: −κ sinκ(s)·P + cosκ(s)·V.
[[nodiscard]] Tangent direction_along(Space space, const Point& p, const Tangent& v, double s);
/// Unit direction at P of the geodesic to Q (the shorter one on S²). Undefined for Q = P or its antipode.
[[nodiscard]] Tangent direction_to(Space space, const Point& p, const Point& q);
/// Midpoint of the geodesic from P to Q (the shorter one on S²).
[[nodiscard]] Point midpoint(Space space, const Point& p, const Point& q);

}  // namespace orbc::geometry
