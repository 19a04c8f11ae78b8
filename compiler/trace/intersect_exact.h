// Curved ray against geodesic triangle: the body of `intersect`, in a header so that the kernels of the BVH can inline it. In the (s, z)
// strip over the ray's floor geodesic the ray is a straight line and the triangle a curve z(s) without vertical tangents, so the root of
// one function of one variable is left to find. Formulas are in intersect.h. The evaluation order at an edge is symmetric in its two ends
// (a·b + c·d, no contraction), which makes neighbouring triangles agree bit by bit (Woop, Benthin, Wald: Watertight Ray/Triangle
// Intersection, 2013, for straight rays).
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

/// The point where the ray's plane cuts an edge: p and v as in RayPlane, height, arc length, and the weight of the edge's first vertex.
struct EdgeCrossing {
  double p = 0, v = 0, z = 0, s = 0, weight = 0;
};

/// A vertex in the frame of the ray's plane: h is sinκ of its distance from the plane, p and v as in RayPlane.
struct VertexProjection {
  double h, p, v, z;
};

template <Space kSpace>
EdgeCrossing edge_crossing(const VertexProjection& i, const VertexProjection& j) {
  const double hi = std::fabs(i.h), hj = std::fabs(j.h), by_sum = 1 / (hi + hj);
  EdgeCrossing x{};
  x.p = (hj * i.p + hi * j.p) * by_sum;
  x.v = (hj * i.v + hi * j.v) * by_sum;
  x.z = (hj * i.z + hi * j.z) * by_sum;
  x.weight = hj * by_sum;
  return x;
}

/// The curve of a triangle in the ray's (s, z) strip between two edge crossings, and its distance G from the ray. On S² `arc_offset` adds
/// whole revolutions to s.
template <Space kSpace>
struct RayStrip {
  static constexpr int kCurvature = geometry::curvature(kSpace);
  EdgeCrossing a, b;
  double c, m, z_ray, arc_offset = 0;
  double dp, dv, dz, twist;  ///< b − a, and p_a·v_b − v_a·p_b = (p² + κv²)·ds/du everywhere

  RayStrip(const EdgeCrossing& from, const EdgeCrossing& to, const RayPlane& plane)
      : a(from), b(to), c(plane.c), m(plane.m), z_ray(plane.z) {
    dp = b.p - a.p;
    dv = b.v - a.v;
    dz = b.z - a.z;
    twist = a.p * b.v - a.v * b.p;
  }
  double distance(double s, double z) const { return c * (z_ray - z) + m * (s + arc_offset); }
  double z_at(double u) const { return a.z + u * dz; }

  struct CurvePoint {
    double u, p, v, s;
  };
  CurvePoint start() const { return {0, a.p, a.v, a.s}; }
  /// The curve point at u; its arc length follows from that of another point by the addition theorem.
  CurvePoint move(const CurvePoint& from, double u) const {
    if constexpr (kSpace == Space::euclidean) {
      const double p = a.p + u * dp, v = a.v + u * dv;
      return {u, p, v, v / p};
    }
    CurvePoint to{u, a.p + u * dp, a.v + u * dv, 0};
    const double over = (u - from.u) * twist, under = from.p * to.p + kCurvature * from.v * to.v;
    if (std::fabs(over) < 0.03125 * under) to.s = from.s + small_arc<kCurvature>(over / under);
    else if constexpr (kSpace == Space::spherical) to.s = from.s + math::atan2(over, under);
    else to.s = from.s + math::atanh(over / under);
    return to;
  }
  /// The same for a small step, with two terms of the arc's series. The caller checks the result.
  CurvePoint step(const CurvePoint& from, double du) const {
    const double u = from.u + du, p = a.p + u * dp, v = a.v + u * dv;
    const double x = du * twist / (from.p * p + kCurvature * from.v * v), y = x * x;
    return {u, p, v, from.s + (x - kCurvature * (1.0 / 3) * x * y)};
  }
  double value(const CurvePoint& at) const { return distance(at.s, z_at(at.u)); }
  double slope(const CurvePoint& at) const { return m * twist / (at.p * at.p + kCurvature * at.v * at.v) - c * dz; }
};

/// The root of G in [lo, hi], where G is monotone and changes its sign: Newton's method from the secant, bracketed.
template <Space kSpace>
typename RayStrip<kSpace>::CurvePoint solve(const RayStrip<kSpace>& strip, double lo, double hi, double g_lo, double g_hi) {
  const double scale = 1e-16 * (1 + std::fabs(strip.a.s) + std::fabs(strip.a.z) + std::fabs(strip.z_ray));
  auto point = strip.move(strip.start(), lo + (hi - lo) * (g_lo / (g_lo - g_hi)));
  for (int i = 0; i < 100; ++i) {
    const double g = strip.value(point), slope = strip.slope(point);
    if (std::fabs(g) <= scale) break;
    ((g < 0) == (g_lo < 0) ? lo : hi) = point.u;
    double next = point.u - g / slope;
    const bool inside = next > lo && next < hi;
    if (!inside) {
      if (std::fabs(next - point.u) * std::fabs(slope) <= 8 * scale || hi - lo < 1e-16) break;
      next = 0.5 * (lo + hi);
    }
    const double step = next - point.u;
    point = strip.move(point, next);
    if (inside && std::fabs(step) < 1e-8) break;  // the next step would be its square
  }
  return point;
}

struct StripRoot {
  double t = kInfinity, u = 0;
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
int turning_points(const RayStrip<kSpace>& strip, double out[2]) {
  if constexpr (kSpace == Space::euclidean) return 0;
  constexpr int k = RayStrip<kSpace>::kCurvature;
  const double rise = strip.c * strip.dz;
  const double A = rise * (strip.dp * strip.dp + k * strip.dv * strip.dv);
  const double B = 2 * rise * (strip.a.p * strip.dp + k * strip.a.v * strip.dv);
  const double C = rise * (strip.a.p * strip.a.p + k * strip.a.v * strip.a.v) - strip.m * strip.twist;
  const double end = A + B + C;
  const bool vertex_inside = B * (2 * A + B) < 0;
  if ((C > 0) == (end > 0) && !vertex_inside) return 0;
  return roots_inside(A, B, C, out);
}

/// The first root of G with t in (t_min, t_max).
template <Space kSpace>
StripRoot first_root(const RayStrip<kSpace>& strip, double t_min, double t_max) {
  double cut[4] = {0, 1, 1, 1}, g[4];
  const int turns = turning_points(strip, cut + 1);
  cut[turns + 1] = 1;
  g[0] = strip.distance(strip.a.s, strip.a.z);  // at the ends the edges' own values, bit by bit
  g[turns + 1] = strip.distance(strip.b.s, strip.b.z);
  if (turns == 0 && (g[0] < 0) == (g[1] < 0)) return {};
  for (int i = 1; i <= turns; ++i) g[i] = strip.value(strip.move(strip.start(), cut[i]));
  StripRoot best;
  for (int i = 0; i <= turns; ++i) {
    if ((g[i] < 0) == (g[i + 1] < 0)) continue;
    const auto point =
        kSpace == Space::euclidean ? strip.move(strip.start(), g[0] / (g[0] - g[1])) : solve(strip, cut[i], cut[i + 1], g[i], g[i + 1]);
    const double t = strip.c * (point.s + strip.arc_offset) + strip.m * (strip.z_at(point.u) - strip.z_ray);
    if (t > t_min && t < t_max && t < best.t) best = {t, point.u};
  }
  return best;
}

/// S²: the geodesic passes the triangle once in every revolution. Returns the hit of the first revolution at which the heights fit.
inline StripRoot first_revolution(RayStrip<Space::spherical> strip, double t_min, double t_max) {
  double first = 0, last = 1;
  if (strip.m != 0) {
    const double za = strip.c * (strip.a.z - strip.z_ray) / strip.m, zb = strip.c * (strip.b.z - strip.z_ray) / strip.m;
    first = std::max(0.0, std::floor((std::min(za, zb) - std::max(strip.a.s, strip.b.s)) / (2 * kPi)));
    last = std::ceil((std::max(za, zb) - std::min(strip.a.s, strip.b.s)) / (2 * kPi));
  }
  for (double k = first; k <= std::min(last, first + 8); ++k) {  // inside the range of heights every revolution has a hit, so few are tried
    strip.arc_offset = 2 * kPi * k;
    const StripRoot found = first_root(strip, t_min, t_max);
    if (found.t < t_max) return found;
  }
  return {};
}

/// The cut of a triangle by the ray's plane: two edges. Each has one of the corners 1 and 2 as its end, and a second end across the plane.
template <Space kSpace>
struct PlaneCut {
  bool cut = false;
  int across_one = 0, across_two = 0;  ///< the edges are (across_one, 1) and (across_two, 2)
  EdgeCrossing one, two;
};

template <Space kSpace>
PlaneCut<kSpace> cut_by_plane(const RayPlane& plane, const Vertex* const vertex[3]) {
  PlaneCut<kSpace> plane_cut;
  VertexProjection projection[3];
  for (int i = 0; i < 3; ++i) projection[i].h = dot(plane.side, *vertex[i]);
  const bool left[3] = {projection[0].h >= 0, projection[1].h >= 0, projection[2].h >= 0};
  if (left[0] == left[1] && left[1] == left[2]) return plane_cut;
  for (int i = 0; i < 3; ++i) {
    projection[i].p = dot(plane.forward, *vertex[i]);
    projection[i].v = dot(plane.sideward, *vertex[i]);
    projection[i].z = vertex[i]->z;
  }
  plane_cut.cut = true;
  plane_cut.across_one = left[0] != left[1] ? 0 : 2;
  plane_cut.across_two = left[0] != left[2] ? 0 : 1;
  plane_cut.one = edge_crossing<kSpace>(projection[plane_cut.across_one], projection[1]);
  plane_cut.two = edge_crossing<kSpace>(projection[plane_cut.across_two], projection[2]);
  return plane_cut;
}

template <Space kSpace>
TriangleHit hit_at(const PlaneCut<kSpace>& plane_cut, double u, double t) {
  TriangleHit hit;
  hit.found = true;
  hit.t = t;
  hit.b[1] = (1 - u) * (1 - plane_cut.one.weight);
  hit.b[2] = u * (1 - plane_cut.two.weight);
  hit.b[plane_cut.across_one] += (1 - u) * plane_cut.one.weight;
  hit.b[plane_cut.across_two] += u * plane_cut.two.weight;
  return hit;
}

template <Space kSpace>
TriangleHit intersect_triangle(const RayPlane& plane, const Vertex* const vertex[3], double t_max) {
  PlaneCut<kSpace> plane_cut = cut_by_plane<kSpace>(plane, vertex);
  if (!plane_cut.cut) return {};
  plane_cut.one.s = arc_of<kSpace>(plane_cut.one.p, plane_cut.one.v);
  plane_cut.two.s = arc_of<kSpace>(plane_cut.two.p, plane_cut.two.v);
  RayStrip<kSpace> strip(plane_cut.one, plane_cut.two, plane);
  StripRoot found;
  if constexpr (kSpace == Space::spherical) {
    // The curve passes the antipode of the start: arcs below 0 count from there.
    if (std::fabs(strip.a.s - strip.b.s) > kPi) (strip.a.s < 0 ? strip.a.s : strip.b.s) += 2 * kPi;
    found = plane.c * t_max > kPi * (1 + 1e-12) ? first_revolution(strip, plane.t_min, t_max) : first_root(strip, plane.t_min, t_max);
  } else {
    found = first_root(strip, plane.t_min, t_max);
  }
  return found.t < t_max ? hit_at(plane_cut, found.u, found.t) : TriangleHit{};
}

/// `intersect_triangle` for a triangle that is known to be hit exactly once, near u = `guess`: one arc function instead of three.
/// Makes: the same point as `intersect_triangle`, up to rounding. In: on S², t_max is at most half a revolution.
template <Space kSpace>
TriangleHit refine_hit(const RayPlane& plane, const Vertex* const vertex[3], double t_max, double guess) {
  const PlaneCut<kSpace> plane_cut = cut_by_plane<kSpace>(plane, vertex);
  if (!plane_cut.cut) return {};
  const RayStrip<kSpace> strip(plane_cut.one, plane_cut.two, plane);
  typename RayStrip<kSpace>::CurvePoint point{guess, plane_cut.one.p + guess * strip.dp, plane_cut.one.v + guess * strip.dv, 0};
  point.s = arc_of<kSpace>(point.p, point.v);
  // Two Newton steps with one slope: the guess is good to 1e-3, so that its square times the change of the slope is below rounding.
  const double by_slope = 1 / strip.slope(point);
  point = strip.step(point, -strip.value(point) * by_slope);
  point = strip.step(point, -strip.value(point) * by_slope);
  const double g = strip.value(point);
  if (!(std::fabs(g) <= 2e-15 && point.u >= 0 && point.u <= 1)) return intersect_triangle<kSpace>(plane, vertex, t_max);
  const double t = strip.c * point.s + strip.m * (strip.z_at(point.u) - strip.z_ray);
  return t > plane.t_min && t < t_max ? hit_at(plane_cut, point.u, t) : TriangleHit{};
}

}  // namespace orbc::trace::exact
