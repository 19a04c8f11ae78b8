// Curved ray against geodesic triangle: the body of `intersect`, in a header so that the kernels of the tree have it inline. Idea: in the
// (s, z) strip over the ray's floor geodesic the ray is a straight line and the triangle a curve z(s) without vertical turns; one function
// of one variable is left. Formulas in intersect.h; the edge evaluation order is symmetric in the two ends (a·b + c·d, no contraction),
// which is what makes neighbours agree bit by bit (Woop, Benthin, Wald: Watertight Ray/Triangle Intersection, 2013, for the straight case).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/trace/arc.h"
#include "compiler/trace/intersect.h"

namespace orbc::trace::exact {

using geometry::Ambient;
using geometry::Space;

constexpr double kPi = std::numbers::pi;

inline double dot(const Ambient& covector, const Vertex& v) { return covector.w * v.w + covector.x * v.x + covector.y * v.y; }

/// A point of an edge over the ray: p and v as in RayPlane, height, arc, and the weight of the edge's first vertex.
struct Crossing {
  double p = 0, v = 0, z = 0, s = 0, weight = 0;
};

struct Seen {
  double h, p, v, z;
};

template <Space kSpace>
Crossing cross_edge(const Seen& i, const Seen& j) {
  const double hi = std::fabs(i.h), hj = std::fabs(j.h), by_sum = 1 / (hi + hj);
  Crossing x{};
  x.p = (hj * i.p + hi * j.p) * by_sum;
  x.v = (hj * i.v + hi * j.v) * by_sum;
  x.z = (hj * i.z + hi * j.z) * by_sum;
  x.weight = hj * by_sum;
  return x;
}

/// The curve over the ray between two crossings, and its distance G from the ray (shifted by `turn` on S²).
template <Space kSpace>
struct Strip {
  static constexpr int kCurvature = geometry::curvature(kSpace);
  Crossing a, b;
  double c, m, z_ray, turn = 0;
  double dp, dv, dz, twist;         ///< b − a, and p_a·v_b − v_a·p_b = (p² + κv²)·ds/du everywhere

  Strip(const Crossing& from, const Crossing& to, const RayPlane& plane) : a(from), b(to), c(plane.c), m(plane.m), z_ray(plane.z) {
    dp = b.p - a.p;
    dv = b.v - a.v;
    dz = b.z - a.z;
    twist = a.p * b.v - a.v * b.p;
  }
  double distance(double s, double z) const { return c * (z_ray - z) + m * (s + turn); }
  double z_at(double u) const { return a.z + u * dz; }

  struct Place {
    double u, p, v, s;
  };
  Place start() const { return {0, a.p, a.v, a.s}; }
  /// The place at u, its arc from that of another place by the addition theorem.
  Place move(const Place& from, double u) const {
    if constexpr (kSpace == Space::euclidean) {
      const double p = a.p + u * dp, v = a.v + u * dv;
      return {u, p, v, v / p};
    }
    Place to{u, a.p + u * dp, a.v + u * dv, 0};
    const double over = (u - from.u) * twist, under = from.p * to.p + kCurvature * from.v * to.v;
    if (std::fabs(over) < 0.03125 * under)
      to.s = from.s + small_arc<kCurvature>(over / under);
    else if constexpr (kSpace == Space::spherical)
      to.s = from.s + math::atan2(over, under);
    else
      to.s = from.s + math::atanh(over / under);
    return to;
  }
  /// The same for a step that is small: two terms of the arc suffice, else the check of the result fails.
  Place step(const Place& from, double du) const {
    const double u = from.u + du, p = a.p + u * dp, v = a.v + u * dv;
    const double x = du * twist / (from.p * p + kCurvature * from.v * v), y = x * x;
    return {u, p, v, from.s + (x - kCurvature * (1.0 / 3) * x * y)};
  }
  double value(const Place& at) const { return distance(at.s, z_at(at.u)); }
  double slope(const Place& at) const { return m * twist / (at.p * at.p + kCurvature * at.v * at.v) - c * dz; }
};

/// The root of a monotone piece with a change of sign: Newton from the secant, kept in its bracket; the place of the root.
template <Space kSpace>
typename Strip<kSpace>::Place solve(const Strip<kSpace>& strip, double lo, double hi, double g_lo, double g_hi) {
  const double scale = 1e-16 * (1 + std::fabs(strip.a.s) + std::fabs(strip.a.z) + std::fabs(strip.z_ray));
  auto place = strip.move(strip.start(), lo + (hi - lo) * (g_lo / (g_lo - g_hi)));
  for (int i = 0; i < 100; ++i) {
    const double g = strip.value(place), slope = strip.slope(place);
    if (std::fabs(g) <= scale) break;
    ((g < 0) == (g_lo < 0) ? lo : hi) = place.u;
    double next = place.u - g / slope;
    const bool inside = next > lo && next < hi;
    if (!inside) {
      if (std::fabs(next - place.u) * std::fabs(slope) <= 8 * scale || hi - lo < 1e-16) break;
      next = 0.5 * (lo + hi);
    }
    const double step = next - place.u;
    place = strip.move(place, next);
    if (inside && std::fabs(step) < 1e-8) break;  // the next step would be its square
  }
  return place;
}

struct Found {
  double t = kEndless, u = 0;
};

/// Roots of A u² + B u + C in (0, 1), in order; numerically stable form.
inline int roots_inside(double A, double B, double C, double out[2]) {
  const double disc = B * B - 4 * A * C;
  if (!(disc > 0)) return 0;
  const double q = -0.5 * (B + std::copysign(std::sqrt(disc), B));
  double r[2] = {q / A, C / q};
  if (r[0] > r[1]) std::swap(r[0], r[1]);
  int count = 0;
  for (double root : r)
    if (root > 0 && root < 1) out[count++] = root;
  return count;
}

/// Where G′ changes sign in (0, 1), in order. G′·(p² + κv²) = m·twist − c·dz·(p² + κv²), a quadratic in u.
template <Space kSpace>
int turning_points(const Strip<kSpace>& strip, double out[2]) {
  if constexpr (kSpace == Space::euclidean) return 0;
  constexpr int k = Strip<kSpace>::kCurvature;
  const double rise = strip.c * strip.dz;
  const double A = rise * (strip.dp * strip.dp + k * strip.dv * strip.dv);
  const double B = 2 * rise * (strip.a.p * strip.dp + k * strip.a.v * strip.dv);
  const double C = rise * (strip.a.p * strip.a.p + k * strip.a.v * strip.a.v) - strip.m * strip.twist;
  const double end = A + B + C;
  const bool vertex_inside = B * (2 * A + B) < 0;
  if ((C > 0) == (end > 0) && !vertex_inside) return 0;
  return roots_inside(A, B, C, out);
}

/// The first root of one strip with t in (t_min, t_max).
template <Space kSpace>
Found first_root(const Strip<kSpace>& strip, double t_min, double t_max) {
  double cut[4] = {0, 1, 1, 1}, g[4];
  const int turns = turning_points(strip, cut + 1);
  cut[turns + 1] = 1;
  g[0] = strip.distance(strip.a.s, strip.a.z);           // the ends: the edges' own values, bit by bit
  g[turns + 1] = strip.distance(strip.b.s, strip.b.z);
  if (turns == 0 && (g[0] < 0) == (g[1] < 0)) return {};
  for (int i = 1; i <= turns; ++i) g[i] = strip.value(strip.move(strip.start(), cut[i]));
  Found best;
  for (int i = 0; i <= turns; ++i) {
    if ((g[i] < 0) == (g[i + 1] < 0)) continue;
    const auto place =
        kSpace == Space::euclidean ? strip.move(strip.start(), g[0] / (g[0] - g[1])) : solve(strip, cut[i], cut[i + 1], g[i], g[i + 1]);
    const double t = strip.c * (place.s + strip.turn) + strip.m * (strip.z_at(place.u) - strip.z_ray);
    if (t > t_min && t < t_max && t < best.t) best = {t, place.u};
  }
  return best;
}

/// S²: the same triangle is met again every full turn; the first turn on which the heights fit.
inline Found first_turn(Strip<Space::spherical> strip, double t_min, double t_max) {
  double first = 0, last = 1;
  if (strip.m != 0) {
    const double za = strip.c * (strip.a.z - strip.z_ray) / strip.m, zb = strip.c * (strip.b.z - strip.z_ray) / strip.m;
    first = std::max(0.0, std::floor((std::min(za, zb) - std::max(strip.a.s, strip.b.s)) / (2 * kPi)));
    last = std::ceil((std::max(za, zb) - std::min(strip.a.s, strip.b.s)) / (2 * kPi));
  }
  for (double k = first; k <= std::min(last, first + 8); ++k) {  // inside the range of heights every turn meets it: few are tried
    strip.turn = 2 * kPi * k;
    const Found found = first_root(strip, t_min, t_max);
    if (found.t < t_max) return found;
  }
  return {};
}

/// What the ray's plane sees of a triangle: the two edges it cuts, each with one corner of its own (1 and 2) and the one across.
template <Space kSpace>
struct Cutting {
  bool cut = false;
  int across_one = 0, across_two = 0;  ///< the edges are (across_one, 1) and (across_two, 2)
  Crossing one, two;
};

template <Space kSpace>
Cutting<kSpace> cut_by(const RayPlane& plane, const Vertex* const vertex[3]) {
  Cutting<kSpace> cutting;
  Seen seen[3];
  for (int i = 0; i < 3; ++i) seen[i].h = dot(plane.side, *vertex[i]);
  const bool left[3] = {seen[0].h >= 0, seen[1].h >= 0, seen[2].h >= 0};
  if (left[0] == left[1] && left[1] == left[2]) return cutting;
  for (int i = 0; i < 3; ++i) {
    seen[i].p = dot(plane.forward, *vertex[i]);
    seen[i].v = dot(plane.sideward, *vertex[i]);
    seen[i].z = vertex[i]->z;
  }
  cutting.cut = true;
  cutting.across_one = left[0] != left[1] ? 0 : 2;
  cutting.across_two = left[0] != left[2] ? 0 : 1;
  cutting.one = cross_edge<kSpace>(seen[cutting.across_one], seen[1]);
  cutting.two = cross_edge<kSpace>(seen[cutting.across_two], seen[2]);
  return cutting;
}

template <Space kSpace>
TriangleHit hit_at(const Cutting<kSpace>& cutting, double u, double t) {
  TriangleHit hit;
  hit.found = true;
  hit.t = t;
  hit.b[1] = (1 - u) * (1 - cutting.one.weight);
  hit.b[2] = u * (1 - cutting.two.weight);
  hit.b[cutting.across_one] += (1 - u) * cutting.one.weight;
  hit.b[cutting.across_two] += u * cutting.two.weight;
  return hit;
}

template <Space kSpace>
TriangleHit meet(const RayPlane& plane, const Vertex* const vertex[3], double t_max) {
  Cutting<kSpace> cutting = cut_by<kSpace>(plane, vertex);
  if (!cutting.cut) return {};
  cutting.one.s = arc_of<kSpace>(cutting.one.p, cutting.one.v);
  cutting.two.s = arc_of<kSpace>(cutting.two.p, cutting.two.v);
  Strip<kSpace> strip(cutting.one, cutting.two, plane);
  Found found;
  if constexpr (kSpace == Space::spherical) {
    // The curve passes the antipode of the start: arcs below 0 count from there.
    if (std::fabs(strip.a.s - strip.b.s) > kPi) (strip.a.s < 0 ? strip.a.s : strip.b.s) += 2 * kPi;
    found = plane.c * t_max > kPi * (1 + 1e-12) ? first_turn(strip, plane.t_min, t_max) : first_root(strip, plane.t_min, t_max);
  } else {
    found = first_root(strip, plane.t_min, t_max);
  }
  return found.t < t_max ? hit_at(cutting, found.u, found.t) : TriangleHit{};
}

/// `meet` for a triangle that is known to be met exactly once, near the fraction `guess` of the way between its two edges: one arc instead
/// of three. The same point as `meet` gives, up to rounding. In: t_max at most half a turn on S².
template <Space kSpace>
TriangleHit meet_once(const RayPlane& plane, const Vertex* const vertex[3], double t_max, double guess) {
  const Cutting<kSpace> cutting = cut_by<kSpace>(plane, vertex);
  if (!cutting.cut) return {};
  const Strip<kSpace> strip(cutting.one, cutting.two, plane);
  typename Strip<kSpace>::Place place{guess, cutting.one.p + guess * strip.dp, cutting.one.v + guess * strip.dv, 0};
  place.s = arc_of<kSpace>(place.p, place.v);
  // Newton, then once more with the same slope: the guess is good to 1e-3, its square times the slope's change is below rounding.
  const double by_slope = 1 / strip.slope(place);
  place = strip.step(place, -strip.value(place) * by_slope);
  place = strip.step(place, -strip.value(place) * by_slope);
  const double g = strip.value(place);
  if (!(std::fabs(g) <= 2e-15 && place.u >= 0 && place.u <= 1)) return meet<kSpace>(plane, vertex, t_max);
  const double t = strip.c * place.s + strip.m * (strip.z_at(place.u) - strip.z_ray);
  return t > plane.t_min && t < t_max ? hit_at(cutting, place.u, t) : TriangleHit{};
}

}  // namespace orbc::trace::exact
