// Formulas: design §2. One formula for all curvatures, or three branches where rounding needs them.
#include "compiler/geometry/point.h"

#include <cmath>

#include "compiler/base/elementary.h"

namespace orbc::geometry {

Point normalised_point(Space space, const Ambient& v) {
  if (space == Space::euclidean) return {1, v.x / v.w, v.y / v.w};
  if (space == Space::spherical) {
    const double n = 1 / std::sqrt(v.w * v.w + v.x * v.x + v.y * v.y);
    return {n * v.w, n * v.x, n * v.y};
  }
  const double rho = std::sqrt(v.x * v.x + v.y * v.y);  // not hypot, for speed: bending normalises every point of every edge
  const double n = 1 / std::sqrt((v.w - rho) * (v.w + rho));
  const double x = n * v.x, y = n * v.y;
  return {std::sqrt(1 + x * x + y * y), x, y};
}

Tangent normalised_tangent(Space space, const Point& p, const Ambient& v) {
  if (space == Space::euclidean) {
    const double n = 1 / math::hypot(v.x, v.y);
    return {0, n * v.x, n * v.y};
  }
  if (space == Space::spherical) {
    const double along = p.w * v.w + p.x * v.x + p.y * v.y;
    const Ambient t = v - along * p;
    const double n = 1 / std::sqrt(t.w * t.w + t.x * t.x + t.y * t.y);
    return {n * t.w, n * t.x, n * t.y};
  }
  // H²: w follows from orthogonality; |t|² = |(x,y)|² − w² is computed as (radial/P_w)² + (transverse)², which cannot cancel.
  const double rho = math::hypot(p.x, p.y);
  if (rho < 1e-300) {
    const double n = 1 / math::hypot(v.x, v.y);
    return {0, n * v.x, n * v.y};
  }
  const double ux = p.x / rho, uy = p.y / rho;
  const double radial = ux * v.x + uy * v.y, transverse = ux * v.y - uy * v.x;
  const double n = 1 / math::hypot(radial / p.w, transverse);
  const double r = n * radial, t = n * transverse;
  return {r * rho / p.w, r * ux - t * uy, r * uy + t * ux};
}

double distance(Space space, const Point& p, const Point& q) {
  const double dx = p.x - q.x, dy = p.y - q.y;
  if (space == Space::euclidean) return math::hypot(dx, dy);
  if (space == Space::spherical) {
    const double cw = p.x * q.y - p.y * q.x, cx = p.y * q.w - p.w * q.y, cy = p.w * q.x - p.x * q.w;
    return math::atan2(std::sqrt(cw * cw + cx * cx + cy * cy), p.w * q.w + p.x * q.x + p.y * q.y);
  }
  // sinh²(d/2) = |P−Q|²/4 = (cosh d − 1)/2. The first is right for neighbours far out (the w difference from ρ² differences, since w
  // alone has lost the small ones), the second for points far apart; each is taken where its largest term is the smaller one.
  const double chord2 = dx * dx + dy * dy, ww = p.w * q.w;
  if (chord2 > 2 * ww) return 2 * math::asinh(std::sqrt(std::fmax(0, (ww - 1) - (p.x * q.x + p.y * q.y)) / 2));
  const double dw = (dx * (p.x + q.x) + dy * (p.y + q.y)) / (p.w + q.w);
  return 2 * math::asinh(std::sqrt(std::fmax(0, chord2 - dw * dw)) / 2);
}

Point point_along(Space space, const Point& p, const Tangent& v, double s) {
  const Ambient x = cos_k(space, s) * p + sin_k(space, s) * v;
  if (space == Space::hyperbolic) return {std::sqrt(1 + x.x * x.x + x.y * x.y), x.x, x.y};
  return {x.w, x.x, x.y};
}

Tangent direction_along(Space space, const Point& p, const Tangent& v, double s) {
  const Ambient t = (-curvature(space) * sin_k(space, s)) * p + cos_k(space, s) * v;
  return {t.w, t.x, t.y};
}

Tangent direction_to(Space space, const Point& p, const Point& q) {
  if (space == Space::euclidean) return normalised_tangent(space, p, q - p);
  const double along = p.w * q.w + curvature(space) * (p.x * q.x + p.y * q.y);
  return normalised_tangent(space, p, q - along * p);
}

Point midpoint(Space space, const Point& p, const Point& q) { return normalised_point(space, p + q); }

}  // namespace orbc::geometry
