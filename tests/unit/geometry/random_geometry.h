#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "compiler/geometry/chart.h"
#include "compiler/geometry/isometry.h"
#include "compiler/geometry/line.h"
#include "compiler/geometry/point.h"

namespace orbc::geometry::testing {

inline constexpr Space kSpaces[] = {Space::hyperbolic, Space::euclidean, Space::spherical};

/// Seeded numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) { return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  bool coin() { return engine_() >> 63; }
  double angle() { return uniform(-std::numbers::pi, std::numbers::pi); }
  /// Reach of a walk that is worth testing: the sphere has no more, far hyperbolic points lose e^r ulp.
  static double reach(Space space) { return space == Space::spherical ? 3.0 : space == Space::euclidean ? 100 : 6; }
  Point point(Space space, double far) { return point_from_log(space, std::polar(far * std::sqrt(uniform(0, 1)), angle())); }
  Point point(Space space) { return point(space, reach(space)); }
  Tangent direction(Space space, const Point& at) {
    const double phi = angle();
    return translation_to(space, at) * Tangent(0, std::cos(phi), std::sin(phi));
  }
  Line line(Space space, double far) {
    const Point p = point(space, far);
    return line_along(space, p, direction(space, p));
  }
  Isometry isometry(Space space, double far) {
    Isometry map = translation_to(space, point(space, far)) * rotation(space, angle());
    return coin() ? map * reflection(space, line(space, far / 2)) : map;
  }

 private:
  std::mt19937_64 engine_;
};

/// How far the vector is from the surface, relative to its size.
inline double off_surface(Space space, const Point& p) {
  const double rho = std::hypot(p.x, p.y);
  if (space == Space::euclidean) return std::fabs(p.w - 1);
  if (space == Space::spherical) return std::fabs(std::hypot(p.w, rho) - 1);
  return std::fabs(p.w - std::hypot(1, rho)) / p.w;
}

/// e^r: what one ulp of a far hyperbolic coordinate is worth.
inline double stretch(Space space, const Point& p) {
  return space == Space::hyperbolic ? p.w + std::hypot(p.x, p.y) : 1 + std::hypot(p.x, p.y);
}

}  // namespace orbc::geometry::testing
