#pragma once
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/geometry/point.h"

namespace orbc::trace {

/// Arc functions of the tracer's inner loops: cheap, and with the same bits on every machine (no libm on S²).

inline constexpr double kAtanOfSixteenths[17] = {  // atan(i/16)
    0.0,
    0.06241880999595735,
    0.12435499454676144,
    0.18534794999569476,
    0.24497866312686414,
    0.3028848683749714,
    0.35877067027057225,
    0.4124104415973873,
    0.4636476090008061,
    0.5123894603107377,
    0.5585993153435624,
    0.6022873461349642,
    0.6435011087932844,
    0.6823165548747481,
    0.7188299996216245,
    0.7531512809621944,
    0.7853981633974483};

/// atanκ(x) = x − κx³/3 + x⁵/5 − … for |x| ≤ 1/32, to the last bit but one.
template <int kCurvature>
[[nodiscard]] inline double small_arc(double x) {
  const double y = -kCurvature * x * x;
  return x + x * y * (1.0 / 3 + y * (1.0 / 5 + y * (1.0 / 7 + y * (1.0 / 9 + y * (1.0 / 11)))));
}

/// atan2(v, p): octant, nearest sixteenth from the table, addition theorem. Error below 4e-16.
[[nodiscard]] inline double arc_of_circle(double p, double v) {
  const double ap = std::fabs(p), av = std::fabs(v);
  const bool steep = ap < av;
  const double big = steep ? av : ap, small = steep ? ap : av;
  // (r − n)/(1 + r·n) with r = small/big, n = i/16: two divisions that do not wait for each other's result but for i.
  const double r = small / big;
  const int i = static_cast<int>(r * 16 + 0.5);
  const double node = i * 0.0625;
  double s = kAtanOfSixteenths[i] + small_arc<1>((small - node * big) / (big + node * small));
  if (steep) s = std::numbers::pi / 2 - s;
  if (p < 0) s = std::numbers::pi - s;
  return std::copysign(s, v);
}

/// Arc length of the point p·P + v·V of the geodesic from P in direction V; on S² in (−π, π].
template <geometry::Space kSpace>
[[nodiscard]] inline double arc_of(double p, double v) {
  if constexpr (kSpace == geometry::Space::euclidean) return v / p;
  if constexpr (kSpace == geometry::Space::hyperbolic) return 0.5 * math::log((p + v) / (p - v));
  return arc_of_circle(p, v);
}

}  // namespace orbc::trace
