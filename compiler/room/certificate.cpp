#include "compiler/room/certificate.h"

#include <cmath>
#include <limits>

#include "compiler/base/elementary.h"
#include "compiler/geometry/predicates.h"
#include "compiler/room/interval.h"
#include "compiler/room/polygon.h"

namespace orbc::room {
namespace {

using geometry::Ambient;
using geometry::Line;
using geometry::Space;

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr double kUlp = std::numeric_limits<double>::epsilon();

double up(const Real& bound) { return std::nextafter(static_cast<double>(bound), kUnbounded); }

struct Enclosed {
  Interval w, x, y;
};
Enclosed enclosed(const Ambient& v) { return {v.w, v.x, v.y}; }
Enclosed enclosed(const Line& l) { return {l.w, l.x, l.y}; }
Interval inner(int k, const Enclosed& a, const Enclosed& b) { return Interval(k) * a.w * b.w + a.x * b.x + a.y * b.y; }

Interval enclosed(const Real& rounded) { return Interval::around(rounded, rounded); }

// |measured − wanted| from sine and cosine of the difference; arcsin s ≤ 1.0001 s below 0.01.
double difference_bound(const Interval& sine, const Interval& cosine) {
  const Real s = sine.magnitude();
  return s < 0.01 && cosine.low() > 0 ? up(s * 1.0001) : kUnbounded;
}

// |angle − wanted| for the interior angle between two walls whose insides are left: cos α = −n·n'/(|n||n'|). No arc functions.
double angle_bound(int k, const Line& before, const Line& after, const CornerAngle& wanted) {
  const Enclosed a = enclosed(before), b = enclosed(after);
  const Interval aa = inner(k, a, a), bb = inner(k, b, b), ab = inner(k, a, b), sine2 = aa * bb - ab * ab;
  if (!(aa.low() > 0 && bb.low() > 0 && sine2.low() > 0)) return kUnbounded;
  const Interval norm = sqrt(aa) * sqrt(bb), sine = sqrt(sine2) / norm, cosine = -ab / norm, ws = enclosed(wanted.sin),
                 wc = enclosed(wanted.cos);
  return difference_bound(sine * wc - cosine * ws, cosine * wc + sine * ws);
}

// |sinκ distance| of a stored point from a stored line, both scaled to the surface.
double distance_bound(int k, const Line& line, const Ambient& at) {
  const Enclosed n = enclosed(line), p = enclosed(at);
  const Interval nn = inner(k, n, n), pp = k == 0 ? p.w * p.w : p.w * p.w + Interval(k) * (p.x * p.x + p.y * p.y);
  if (!(nn.low() > 0 && pp.low() > 0)) return kUnbounded;
  const Interval value = n.w * p.w + n.x * p.x + n.y * p.y;
  // arcsin v ≤ πv/2 on S²; arsinh v ≤ v.
  const Real bound = value.magnitude() / (sqrt(nn) * sqrt(pp)).low();
  return up(k > 0 ? (bound > 0.01 ? bound * 1.5708 : bound * 1.0001) : bound);
}

// |stored length − distance of the stored ends|, from the chord: 2 sinκ(d/2).
double length_bound(int k, const Ambient& p, const Ambient& q, double length) {
  const Enclosed a = enclosed(p), b = enclosed(q);
  const Interval dx = b.x - a.x, dy = b.y - a.y, flat = dx * dx + dy * dy;
  if (k == 0) return up((sqrt(flat) - Interval(length)).magnitude());
  const Interval dw = b.w - a.w, chord2 = flat + Interval(k) * dw * dw;
  if (!(chord2.low() > 0)) return kUnbounded;
  if (k > 0) {
    // Half the chord is the sine of half the distance, √(4 − chord²)/2 its cosine (0 for the ends of a half circle).
    const Interval rest2 = Interval(4) - chord2, rest = rest2.low() > 0 ? sqrt(rest2) : Interval::around(0, sqrt(abs(rest2.high())));
    const Interval sine = sqrt(chord2) / Interval(2), cosine = rest / Interval(2), ws = enclosed(sin(Real(length) / 2)),
                   wc = enclosed(cos(Real(length) / 2));
    return 2 * difference_bound(sine * wc - cosine * ws, cosine * wc + sine * ws);
  }
  // arsinh has slope ≤ 1: its value at the upper end, minus the width.
  const Interval half = sqrt(chord2) / Interval(2);
  const Real high = 2 * asinh(half.high());
  return up((Interval::around(high - 2 * (half.high() - half.low()), high) - Interval(length)).magnitude());
}

// |area of the outline − room.area|. E²: the shoelace formula. Else triangles with the origin: tan(A/2) = det/(1 + O·P + P·Q + Q·O)
// (Eriksson 1990, On the measure of solid angles; the same with the Lorentz form). The half areas are added by multiplying complex numbers;
// the sum in double gives the number of full turns of the product.
double area_bound(const Room& room) {
  const int k = geometry::curvature(room.space);
  // A product of enclosing boxes would grow by √2 with every turn. So the midpoints are multiplied, and the relative errors added.
  Real x = 1, y = 0, error = 0;
  Interval flat(0);
  double sum = 0;
  for (std::size_t i = 0; i < room.outline.size(); ++i) {
    const Enclosed p = enclosed(room.outline[i]), q = enclosed(room.outline[(i + 1) % room.outline.size()]);
    const Interval det = p.x * q.y - p.y * q.x;
    flat = flat + det / Interval(2);
    const Interval base = Interval(1) + p.w + q.w + p.w * q.w + Interval(k) * (p.x * q.x + p.y * q.y);
    if (!(det.low() > 0)) return kUnbounded;
    error += (det.high() - det.low() + base.high() - base.low()) / std::max(det.low(), base.magnitude()) + ldexp(Real(1), -160);
    const Real turned = x * base.low() - y * det.low();
    y = x * det.low() + y * base.low();
    x = turned;
    sum += 2 * math::atan2(static_cast<double>(det.low()), static_cast<double>(base.low()));
  }
  if (k == 0) return up((flat - Interval(room.area)).magnitude());
  if (!(std::fabs(sum - room.area) < 1)) return kUnbounded;
  const Real norm = sqrt(x * x + y * y), s = sin(Real(room.area) / 2), c = cos(Real(room.area) / 2);
  const Real sine = (y * c - x * s) / norm, cosine = (x * c + y * s) / norm, more = 2 * error;
  return 2 * difference_bound(Interval::around(sine - more, sine + more), Interval::around(cosine - more, cosine + more));
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
  const std::vector<CornerAngle> angles = corner_angles(room.orbifold.strip ? std::vector<Rational>(4, 2) : room.orbifold.corners);
  for (std::size_t i = 0; i < n; ++i) {
    const Line &before = room.walls[(i + n - 1) % n].line, &after = room.walls[i].line;
    c.angle_residual = std::max(c.angle_residual, angle_bound(k, before, after, angles[i]));
    c.closure_residual =
        std::max({c.closure_residual, distance_bound(k, before, room.corners[i].at), distance_bound(k, after, room.corners[i].at)});
    c.side_residual = std::max(c.side_residual, length_bound(k, room.corners[i].at, room.corners[(i + 1) % n].at, room.walls[i].length));
  }
  if (n == 0)
    for (const geometry::Point& p : room.outline)
      c.closure_residual = std::max(c.closure_residual, distance_bound(k, room.walls[0].line, p));
  c.area_residual = area_bound(room);
  return c;
}

bool passes(const Room& room, const Certificate& c) {
  // At distance r one ulp of a coordinate moves a point by cosh r ulps, and a line by cosh² r.
  const double size = room.space == Space::hyperbolic ? math::cosh(room.circumradius) : 1;
  const double scale = room.space == Space::euclidean ? room.circumradius : 1;
  const double rounding = 64 * kUlp * size * size;
  double sharpest = 1;
  for (const Corner& corner : room.corners) sharpest = std::min(sharpest, math::sin(corner.angle));
  const auto within = [](double value, double explained, double bound) { return value <= explained && value <= bound; };
  const double count = static_cast<double>(std::max<std::size_t>(room.outline.size(), 4));
  return c.convex && within(c.angle_residual, rounding / sharpest, std::max(1e-2 * sharpest, 16 * kUlp)) &&
         within(c.closure_residual, rounding * scale, 1e-2 * scale) && within(c.side_residual, rounding * scale, 1e-2 * scale) &&
         within(c.area_residual, count * rounding * scale * scale, 1e-1 * scale * scale);
}

}  // namespace orbc::room
