// Curved ray against geodesic triangle. Idea: in the (s, z) strip over the ray's floor geodesic the ray is a straight line and the triangle a
// curve z(s) without vertical turns; one function of one variable is left. Formulas in intersect.h; the edge evaluation order is symmetric in
// the two ends (a·b + c·d, no contraction), which is what makes neighbours agree bit by bit (Woop, Benthin, Wald: Watertight Ray/Triangle
// Intersection, 2013, for the straight case).
#include "compiler/trace/intersect.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orbc::trace {

using geometry::Ambient;
using geometry::Space;

namespace {

constexpr double kPi = std::numbers::pi;

double dot(const Ambient& covector, const Vertex& v) { return covector.w * v.w + covector.x * v.x + covector.y * v.y; }

/// A point of an edge over the ray: p and v as in RayPlane, height, and the weight of the edge's first vertex.
struct Crossing {
  double p, v, z, s, weight;
};

struct Seen {
  double h, p, v, z;
};

double arc(Space space, double p, double v) {
  if (space == Space::spherical) return std::atan2(v, p);
  return space == Space::hyperbolic ? std::atanh(v / p) : v / p;
}

Crossing cross_edge(Space space, const Seen& i, const Seen& j) {
  const double hi = std::fabs(i.h), hj = std::fabs(j.h), sum = hi + hj;
  Crossing x{};
  x.p = (hj * i.p + hi * j.p) / sum;
  x.v = (hj * i.v + hi * j.v) / sum;
  x.z = (hj * i.z + hi * j.z) / sum;
  x.weight = hj / sum;
  x.s = arc(space, x.p, x.v);
  return x;
}

/// The curve over the ray between two crossings, and its distance G from the ray (shifted by `turn` on S²).
struct Strip {
  Space space;
  Crossing a, b;
  double c, m, z_ray, turn;
  bool wrap;  ///< S²: the curve passes the antipode of the start; arcs below 0 count from there

  double s_at(double u) const {
    const double s = arc(space, a.p + u * (b.p - a.p), a.v + u * (b.v - a.v));
    return (wrap && s < 0 ? s + 2 * kPi : s) + turn;
  }
  double z_at(double u) const { return a.z + u * (b.z - a.z); }
  double distance(double s, double z) const { return c * (z_ray - z) + m * s; }
  double value(double u) const { return distance(s_at(u), z_at(u)); }
  double slope(double u) const {
    const double p = a.p + u * (b.p - a.p), v = a.v + u * (b.v - a.v);
    return m * (a.p * b.v - a.v * b.p) / (p * p + geometry::curvature(space) * v * v) - c * (b.z - a.z);
  }
};

/// Roots of A u² + B u + C in (0, 1), in order; numerically stable form.
int roots_inside(double A, double B, double C, double out[2]) {
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

/// The root of a monotone piece with a change of sign: Newton from the secant, kept in its bracket.
double solve(const Strip& strip, double lo, double hi, double g_lo, double g_hi) {
  double u = lo + (hi - lo) * (g_lo / (g_lo - g_hi));
  for (int i = 0; i < 80; ++i) {
    if (!(u > lo && u < hi)) u = 0.5 * (lo + hi);
    const double g = strip.value(u);
    if (g == 0) return u;
    ((g < 0) == (g_lo < 0) ? lo : hi) = u;
    const double next = u - g / strip.slope(u);
    if (std::fabs(next - u) <= 1e-15 || hi - lo <= 1e-16) return next > lo && next < hi ? next : u;
    u = next;
  }
  return u;
}

struct Found {
  double t = kEndless, u = 0;
};

/// The first root of one strip with t in (t_min, t_max).
Found first_root(const Strip& strip, double t_min, double t_max) {
  double cut[4] = {0, 1, 1, 1};
  int pieces = 1;
  if (strip.space != Space::euclidean) {
    const double dp = strip.b.p - strip.a.p, dv = strip.b.v - strip.a.v, rise = strip.c * (strip.b.z - strip.a.z);
    const double k = geometry::curvature(strip.space), w = strip.a.p * strip.b.v - strip.a.v * strip.b.p;
    double inside[2];
    const int count = roots_inside(rise * (dp * dp + k * dv * dv), 2 * rise * (strip.a.p * dp + k * strip.a.v * dv),
                                   rise * (strip.a.p * strip.a.p + k * strip.a.v * strip.a.v) - strip.m * w, inside);
    for (int i = 0; i < count; ++i) cut[pieces++] = inside[i];
    cut[pieces] = 1;
  }
  Found best;
  double g[4];
  for (int i = 0; i <= pieces; ++i) {
    const bool end = i == 0 || i == pieces;  // the ends must be the edges' own values, bit by bit
    g[i] = end ? strip.distance((i == 0 ? strip.a.s : strip.b.s) + strip.turn, i == 0 ? strip.a.z : strip.b.z) : strip.value(cut[i]);
    if (i == 0 || (g[i] < 0) == (g[i - 1] < 0)) continue;
    const double u = strip.space == Space::euclidean ? g[0] / (g[0] - g[1]) : solve(strip, cut[i - 1], cut[i], g[i - 1], g[i]);
    const double t = strip.c * strip.s_at(u) + strip.m * (strip.z_at(u) - strip.z_ray);
    if (t > t_min && t < t_max && t < best.t) best = {t, u};
  }
  return best;
}

/// S²: the same triangle is met again every full turn; the first turn on which the heights fit.
Found first_turn(Strip strip, double t_min, double t_max) {
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

}  // namespace

RayPlane plane_of(Space space, const Ray& ray) {
  const auto& p = ray.at;
  const auto& v = ray.along;
  const double k = geometry::curvature(space);
  RayPlane plane;
  plane.space = space;
  plane.side = {p.x * v.y - p.y * v.x, p.y * v.w - p.w * v.y, p.w * v.x - p.x * v.w};
  plane.forward = {p.w, k * p.x, k * p.y};
  plane.sideward = {space == Space::euclidean ? -(p.x * v.x + p.y * v.y) : k * v.w, v.x, v.y};
  plane.z = ray.z;
  plane.c = ray.c;
  plane.m = ray.m;
  plane.t_min = ray.t_min;
  return plane;
}

TriangleHit intersect(const RayPlane& plane, const Vertex& a, const Vertex& b, const Vertex& c, double t_max) {
  const Vertex* vertex[3] = {&a, &b, &c};
  Seen seen[3];
  for (int i = 0; i < 3; ++i) seen[i].h = dot(plane.side, *vertex[i]);
  const bool left[3] = {seen[0].h >= 0, seen[1].h >= 0, seen[2].h >= 0};
  if (left[0] == left[1] && left[1] == left[2]) return {};
  for (int i = 0; i < 3; ++i) {
    seen[i].p = dot(plane.forward, *vertex[i]);
    seen[i].v = dot(plane.sideward, *vertex[i]);
    seen[i].z = vertex[i]->z;
  }
  const int o = left[0] == left[1] ? 2 : left[0] == left[2] ? 1 : 0;  // alone on its side
  const int j = (o + 1) % 3, k = (o + 2) % 3;
  Strip strip{plane.space, cross_edge(plane.space, seen[o], seen[j]), cross_edge(plane.space, seen[o], seen[k]),
              plane.c, plane.m, plane.z, 0, false};
  Found found;
  if (plane.space == Space::spherical) {
    strip.wrap = std::fabs(strip.a.s - strip.b.s) > kPi;
    if (strip.wrap) (strip.a.s < 0 ? strip.a.s : strip.b.s) += 2 * kPi;
    found = plane.c * t_max > kPi * (1 + 1e-12) ? first_turn(strip, plane.t_min, t_max) : first_root(strip, plane.t_min, t_max);
  } else {
    found = first_root(strip, plane.t_min, t_max);
  }
  if (!(found.t < t_max)) return {};
  TriangleHit hit;
  hit.found = true;
  hit.t = found.t;
  hit.b[j] = (1 - found.u) * (1 - strip.a.weight);
  hit.b[k] = found.u * (1 - strip.b.weight);
  hit.b[o] = 1 - hit.b[j] - hit.b[k];
  return hit;
}

}  // namespace orbc::trace
