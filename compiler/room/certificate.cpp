#include "compiler/room/certificate.h"

#include <cmath>
#include <limits>

#include "compiler/geometry/predicates.h"
#include "compiler/room/interval.h"
#include "compiler/room/polygon.h"

namespace orbc::room {
namespace {

using geometry::Ambient;
using geometry::Line;
using geometry::Space;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kUlp = std::numeric_limits<double>::epsilon();

double up(const Real& bound) { return std::nextafter(static_cast<double>(bound), kInfinite); }

struct Enclosed {
  Interval w, x, y;
};
Enclosed enclosed(const Ambient& v) { return {v.w, v.x, v.y}; }
Enclosed enclosed(const Line& l) { return {l.w, l.x, l.y}; }
Interval inner(int k, const Enclosed& a, const Enclosed& b) { return Interval(k) * a.w * b.w + a.x * b.x + a.y * b.y; }

Interval pi() { return Interval::around(real_pi(), real_pi()); }

// Interior angle between two walls whose insides are left: cos α = −n·n'/(|n||n'|).
bool enclose_angle(int k, const Line& before, const Line& after, Interval& angle) {
  const Enclosed a = enclosed(before), b = enclosed(after);
  const Interval aa = inner(k, a, a), bb = inner(k, b, b), ab = inner(k, a, b), sine2 = aa * bb - ab * ab;
  if (!(aa.low() > 0 && bb.low() > 0 && sine2.low() > 0)) return false;
  angle = atan2(sqrt(sine2), -ab);
  return true;
}

// |sinκ distance| of a stored point from a stored line, both scaled to the surface.
double distance_bound(int k, const Line& line, const Ambient& at) {
  const Enclosed n = enclosed(line), p = enclosed(at);
  const Interval nn = inner(k, n, n), pp = k == 0 ? p.w * p.w : p.w * p.w + Interval(k) * (p.x * p.x + p.y * p.y);
  if (!(nn.low() > 0 && pp.low() > 0)) return kInfinite;
  const Interval value = n.w * p.w + n.x * p.x + n.y * p.y;
  // arcsin v ≤ πv/2 on S²; arsinh v ≤ v.
  const Real bound = value.magnitude() / (sqrt(nn) * sqrt(pp)).low();
  return up(k > 0 ? (bound > 0.01 ? bound * 1.5708 : bound * 1.0001) : bound);
}

// |stored length − distance of the stored ends|, by tan or tanh of half the distance (H²: e^d from the half chord).
double length_bound(int k, const Ambient& p, const Ambient& q, double length) {
  const Enclosed a = enclosed(p), b = enclosed(q);
  const Interval dx = b.x - a.x, dy = b.y - a.y, flat = dx * dx + dy * dy;
  if (k == 0) return up((sqrt(flat) - Interval(length)).magnitude());
  const Interval dw = b.w - a.w, chord2 = flat + Interval(k) * dw * dw;
  if (!(chord2.low() > 0)) return kInfinite;
  if (k > 0) {
    const Interval rest = Interval(4) - chord2;
    if (!(rest.low() > 0)) return up(abs(real_pi() - Real(length)) + 2 * sqrt(abs(rest.high())));
    return up((Interval(2) * atan2(sqrt(chord2), sqrt(rest)) - Interval(length)).magnitude());
  }
  // 2 arsinh(c/2) lies between its values at the ends of the enclosure of c; widened like every operation.
  const Interval half = sqrt(chord2) / Interval(2);
  const Interval measured = Interval::around(2 * asinh(half.low()), 2 * asinh(half.high()));
  return up((measured - Interval(length)).magnitude());
}

// Area of the outline as a sum of triangles with the origin: tan(A/2) = κ-free |det|/(1 + O·P + P·Q + Q·O); E²: the shoelace formula.
// (Eriksson 1990, On the measure of solid angles; the same with the Lorentz form.)
bool enclose_area(const Room& room, Interval& area) {
  const int k = geometry::curvature(room.space);
  area = Interval(0);
  for (std::size_t i = 0; i < room.outline.size(); ++i) {
    const Enclosed p = enclosed(room.outline[i]), q = enclosed(room.outline[(i + 1) % room.outline.size()]);
    const Interval det = p.x * q.y - p.y * q.x;
    if (k == 0) {
      area = area + det / Interval(2);
      continue;
    }
    const Interval base = Interval(1) + p.w + q.w + p.w * q.w + Interval(k) * (p.x * q.x + p.y * q.y);
    if (!(det.low() > 0)) return false;
    area = area + Interval(2) * atan2(det, base);
  }
  return true;
}

bool is_half_sphere(const Room& room) {
  for (const geometry::Point& p : room.outline)
    if (p.w != 0) return false;
  return geometry::contains(room.outline, geometry::Point()) == geometry::Containment::inside;
}

}  // namespace

Certificate certify(const Room& room) {
  const int k = geometry::curvature(room.space);
  const std::size_t n = room.corners.size();
  Certificate c;
  c.convex = n == 0 ? is_half_sphere(room) : geometry::is_convex(room.outline);
  const std::vector<CornerAngle> angles = corner_angles(room.orbifold.corners);
  for (std::size_t i = 0; i < n; ++i) {
    const Line &before = room.walls[(i + n - 1) % n].line, &after = room.walls[i].line;
    const Interval wanted = room.orbifold.strip ? pi() / Interval(2) : Interval::around(angles[i].angle, angles[i].angle);
    Interval angle(0);
    const bool known = enclose_angle(k, before, after, angle);
    c.angle_residual = std::max(c.angle_residual, known ? up((angle - wanted).magnitude()) : kInfinite);
    c.closure_residual = std::max({c.closure_residual, distance_bound(k, before, room.corners[i].at), distance_bound(k, after, room.corners[i].at)});
    c.side_residual = std::max(c.side_residual, length_bound(k, room.corners[i].at, room.corners[(i + 1) % n].at, room.walls[i].length));
  }
  if (n == 0)
    for (const geometry::Point& p : room.outline) c.closure_residual = std::max(c.closure_residual, distance_bound(k, room.walls[0].line, p));
  Interval area(0);
  c.area_residual = enclose_area(room, area) ? up((area - Interval(room.area)).magnitude()) : kInfinite;
  return c;
}

bool is_granted(const Room& room, const Certificate& c) {
  // One ulp of a coordinate at distance r moves a point by cosh r ulps, and a line of slope cosh r by as much again.
  const double size = room.space == Space::hyperbolic ? std::cosh(room.circumradius) : 1;
  const double scale = room.space == Space::euclidean ? room.circumradius : 1;
  const double rounding = 64 * kUlp * size * size;
  double sharpest = 1;
  for (const Corner& corner : room.corners) sharpest = std::min(sharpest, std::sin(corner.angle));
  const auto within = [](double value, double explained, double most) { return value <= explained && value <= most; };
  const double count = static_cast<double>(std::max<std::size_t>(room.outline.size(), 4));
  return c.convex && within(c.angle_residual, rounding / sharpest, std::max(1e-2 * sharpest, 16 * kUlp)) && within(c.closure_residual, rounding * scale, 1e-2 * scale) &&
         within(c.side_residual, rounding * scale, 1e-2 * scale) && within(c.area_residual, count * rounding * scale * scale, 1e-1 * scale * scale);
}

}  // namespace orbc::room
