// The border of the prism by formula (analytic.h). Box triangles as walls lose rays in corners even in robust tracers (performance study,
// accuracy table); one inequality per wall does not.
#include "compiler/trace/analytic.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orbc::trace {

using geometry::Point;
using geometry::Space;

Exit exit_of(const Prism& prism, const Ray& ray) {
  Exit exit;
  const Space space = prism.space;
  if (ray.c > 0) {
    double largest = space == Space::spherical ? -kEndless : geometry::curvature(space) < 0 ? 1.0 : 0.0;
    int first = -1;
    for (int i = 0; i < static_cast<int>(prism.walls.size()); ++i) {
      const double at = std::max(0.0, geometry::value_at(prism.walls[i].line, ray.at));
      const double towards = -geometry::value_at(prism.walls[i].line, ray.along);
      if (i == ray.leaves_wall && !(space == Space::spherical && prism.walls.size() <= 2)) continue;
      const double cot = i == ray.leaves_wall ? -kEndless : at > 0 ? towards / at : towards > 0 ? kEndless : -kEndless;
      if (cot > largest || (first < 0 && space == Space::spherical && cot == largest)) {
        largest = cot;
        first = i;
      }
    }
    if (first >= 0) {
      const double s = space == Space::spherical ? std::numbers::pi / 2 - std::atan(largest)
                       : space == Space::euclidean ? 1 / largest
                                                   : std::atanh(1 / largest);
      exit = {s / ray.c, first};
    }
  }
  if (ray.m != 0) {
    const double t = std::max(0.0, ((ray.m > 0 ? prism.height : 0) - ray.z) / ray.m);
    if (t < exit.t) exit = {t, ray.m > 0 ? kCeiling : kFloor};
  }
  return exit;
}

Ray reflected_in_wall(const Prism& prism, const Ray& ray, double t, int wall) {
  const geometry::Position at = position_at(prism.space, ray, t);
  const geometry::Line& n = prism.walls[wall].line;
  const geometry::Ambient v = geometry::direction_along(prism.space, ray.at, ray.along, ray.c * t);
  const double twice = 2 * geometry::value_at(n, v), k = geometry::curvature(prism.space);
  Ray out = ray;
  // Back onto the wall's line, then onto the surface: neither the distance from the wall nor ⟨P, P⟩ drifts.
  out.at = geometry::foot(prism.space, n, at.floor);
  out.along = geometry::normalised_tangent(prism.space, out.at, {v.w - twice * k * n.w, v.x - twice * n.x, v.y - twice * n.y});
  out.z = at.z;
  out.t_min = 0;
  out.leaves_wall = wall;
  return out;
}

Ray reflected_in_plane(const Prism& prism, const Ray& ray, double t, int surface) {
  Ray out = ray;
  out.at = geometry::normalised_point(prism.space, geometry::point_along(prism.space, ray.at, ray.along, ray.c * t));
  out.along = geometry::normalised_tangent(prism.space, out.at, geometry::direction_along(prism.space, ray.at, ray.along, ray.c * t));
  out.z = surface == kCeiling ? prism.height : 0;
  out.m = -ray.m;
  out.t_min = 0;
  if (t > 0) out.leaves_wall = -1;
  return out;
}

double arc_on_wall(Space space, const room::Wall& wall, const Point& x) {
  const double k = geometry::curvature(space);
  if (space == Space::euclidean) return (x.x - wall.start.x) * wall.along.x + (x.y - wall.start.y) * wall.along.y;
  const double p = wall.start.w * x.w + k * (wall.start.x * x.x + wall.start.y * x.y);
  const double v = k * wall.along.w * x.w + wall.along.x * x.x + wall.along.y * x.y;
  if (space == Space::hyperbolic) return std::atanh(v / p);
  const double s = std::atan2(v, p);
  return s < 0 && wall.length > std::numbers::pi + 1e-6 ? s + 2 * std::numbers::pi : s;
}

Direction normal_of_wall(Space space, const room::Wall& wall) {
  return {{geometry::curvature(space) * wall.line.w, wall.line.x, wall.line.y}, 0};
}

}  // namespace orbc::trace
