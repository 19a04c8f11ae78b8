// Lines are planes through the origin of the ambient space, stored as normal covectors (Thurston, Three-Dimensional Geometry
// and Topology, §2.4: hyperboloid model; the same algebra serves the sphere and, with w as scale, the plane).
#include "compiler/geometry/line.h"

#include <cmath>

#include "compiler/base/elementary.h"

namespace orbc::geometry {
namespace {

constexpr Line covector_cross(const Ambient& p, const Ambient& q) {
  return {p.x * q.y - p.y * q.x, p.y * q.w - p.w * q.y, p.w * q.x - p.x * q.w};
}

}  // namespace

Line normalised_line(Space space, const Line& l) {
  const double n2 = space == Space::hyperbolic ? (math::hypot(l.x, l.y) - std::fabs(l.w)) * (math::hypot(l.x, l.y) + std::fabs(l.w))
                                               : l.x * l.x + l.y * l.y + curvature(space) * l.w * l.w;
  const double n = 1 / std::sqrt(n2);
  return {n * l.w, n * l.x, n * l.y};
}

Line line_through(Space space, const Point& p, const Point& q) { return normalised_line(space, covector_cross(p, q)); }

Line line_along(Space space, const Point& p, const Tangent& v) { return normalised_line(space, covector_cross(p, v)); }

double signed_distance(Space space, const Line& line, const Point& x) { return asin_k(space, value_at(line, x)); }

Point intersection(Space space, const Line& a, const Line& b) {
  Ambient v{a.x * b.y - a.y * b.x, a.y * b.w - a.w * b.y, a.w * b.x - a.x * b.w};
  if (v.w < 0) v = -1 * v;
  return normalised_point(space, v);
}

Point foot(Space space, const Line& line, const Point& x) {
  const double v = value_at(line, x);
  return normalised_point(space, {x.w - curvature(space) * v * line.w, x.x - v * line.x, x.y - v * line.y});
}

}  // namespace orbc::geometry
