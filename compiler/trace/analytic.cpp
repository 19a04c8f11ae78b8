// The border of the prism by formula (analytic.h). Walls made of triangles lose rays in corners even in robust tracers (performance study,
// accuracy table); one inequality per wall loses none.
#include "compiler/trace/analytic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/trace/arc.h"

namespace orbc::trace {

using geometry::Point;
using geometry::Space;

namespace {

/// A lower bound of atanh x: the first terms of its series, all of which are positive.
double atanh_from_below(double x) {
  const double y = x * x;
  return x * (1 + y * (1.0 / 3 + y * (1.0 / 5 + y * (1.0 / 7))));
}

/// The arc whose cotκ is given.
double arc_of_cot(Space space, double cot) {
  if (space == Space::euclidean) return 1 / cot;
  if (space == Space::spherical) return std::fabs(cot) == kInfinity ? (cot > 0 ? 0 : std::numbers::pi) : arc_of_circle(cot, 1);
  return cot == kInfinity ? 0 : 0.5 * math::log((cot + 1) / (cot - 1));
}

}  // namespace

Exit exit_of(const Prism& prism, const Ray& ray, double within) {
  Exit exit;
  const Space space = prism.space;
  if (ray.c > 0) {
    double largest = space == Space::spherical ? -kInfinity : geometry::curvature(space) < 0 ? 1.0 : 0.0;
    int first = -1;
    for (int i = 0; i < static_cast<int>(prism.walls.size()); ++i) {
      const double at = std::max(0.0, geometry::value_at(prism.walls[i].line, ray.at));
      const double outward = -geometry::value_at(prism.walls[i].line, ray.along);
      if (i == ray.start_wall && !(space == Space::spherical && prism.walls.size() <= 2)) continue;
      const double cot = i == ray.start_wall ? -kInfinity : at > 0 ? outward / at : outward > 0 ? kInfinity : -kInfinity;
      if (cot > largest || (first < 0 && space == Space::spherical && cot == largest)) {
        largest = cot;
        first = i;
      }
    }
    if (first >= 0) {
      const bool beyond = space == Space::hyperbolic && within < kInfinity && atanh_from_below(1 / largest) > 1.000001 * ray.c * within;
      exit = {beyond ? kInfinity : arc_of_cot(space, largest) / ray.c, first, largest};
    }
  }
  if (ray.m != 0) {
    const double t = std::max(0.0, ((ray.m > 0 ? prism.height : 0) - ray.z) / ray.m);
    if (t < exit.t) exit = {t, ray.m > 0 ? kCeiling : kFloor};
  }
  return exit;
}

namespace {

/// The floor point and the direction there after arc length s along the ray; both share one exponential, or one sine and cosine.
struct PointAndDirection {
  geometry::Ambient at, along;
};

/// In: cosκ and sinκ of the arc.
PointAndDirection step(Space space, const Ray& ray, double cosine, double sine) {
  const geometry::Ambient p = ray.at, v = ray.along;
  return {cosine * p + sine * v, (-geometry::curvature(space) * sine) * p + cosine * v};
}

PointAndDirection step_along(Space space, const Ray& ray, double s) {
  double cosine = 1, sine = s;
  if (space == Space::spherical) {
    cosine = math::cos(s);
    sine = math::sin(s);
  }
  if (space == Space::hyperbolic) {
    const double e = math::exp(s);
    cosine = 0.5 * (e + 1 / e);
    sine = 0.5 * (e - 1 / e);
  }
  return step(space, ray, cosine, sine);
}

/// The same by cotκ of the arc: sinκ = 1/√(cotκ² + κ).
PointAndDirection step_by_cot(Space space, const Ray& ray, double cot) {
  if (std::fabs(cot) == kInfinity) return step(space, ray, cot > 0 ? 1 : -1, 0);
  if (space == Space::euclidean) return step(space, ray, 1, 1 / cot);
  const double sine = 1 / std::sqrt(space == Space::spherical ? 1 + cot * cot : (cot - 1) * (cot + 1));
  return step(space, ray, cot * sine, sine);
}

/// Sets the ray's start to (P, V), projected: P onto the space, V onto the unit tangents at P. H²: the form |V|² = (|V_xy|² + (P ×
/// V)²)/P_w² has no cancellation.
void reproject(Space space, const PointAndDirection& from, Ray& ray) {
  const auto& [p, v] = from;
  if (space == Space::euclidean) {
    const double n = 1 / std::sqrt(v.x * v.x + v.y * v.y);
    ray.at = {1, p.x, p.y};
    ray.along = {0, n * v.x, n * v.y};
  } else if (space == Space::spherical) {
    const double n = 1 / std::sqrt(p.w * p.w + p.x * p.x + p.y * p.y);
    ray.at = {n * p.w, n * p.x, n * p.y};
    const double radial = ray.at.w * v.w + ray.at.x * v.x + ray.at.y * v.y;
    const geometry::Ambient t = v - radial * ray.at;
    const double l = 1 / std::sqrt(t.w * t.w + t.x * t.x + t.y * t.y);
    ray.along = {l * t.w, l * t.x, l * t.y};
  } else {
    const double w = std::sqrt(1 + p.x * p.x + p.y * p.y), cross = p.x * v.y - p.y * v.x;
    const double n = w / std::sqrt(v.x * v.x + v.y * v.y + cross * cross);
    ray.at = {w, p.x, p.y};
    ray.along = {n * (v.x * p.x + v.y * p.y) / w, n * v.x, n * v.y};
  }
}

/// In: point and direction where the ray has reached the wall.
Ray reflected_at(const Prism& prism, const Ray& ray, const Exit& exit, PointAndDirection moved) {
  const geometry::Line& n = prism.walls[exit.surface].line;
  // The point is projected onto the wall's line and the direction reflected, so that neither the distance from the wall nor ⟨P, P⟩ drifts.
  const geometry::Ambient normal{geometry::curvature(prism.space) * n.w, n.x, n.y};
  moved.at = moved.at - geometry::value_at(n, moved.at) * normal;
  moved.along = moved.along - (2 * geometry::value_at(n, moved.along)) * normal;
  Ray out = ray;
  reproject(prism.space, moved, out);
  out.z = ray.z + ray.m * exit.t;
  out.t_min = 0;
  out.start_wall = exit.surface;
  return out;
}

}  // namespace

Ray reflected_in_wall(const Prism& prism, const Ray& ray, double t, int wall) {
  return reflected_at(prism, ray, {t, wall}, step_along(prism.space, ray, ray.c * t));
}

Ray reflected_in_wall(const Prism& prism, const Ray& ray, const Exit& exit) {
  return reflected_at(prism, ray, exit, step_by_cot(prism.space, ray, exit.cot_arc));
}

Ray reflected_in_plane(const Prism& prism, const Ray& ray, double t, int surface) {
  Ray out = ray;
  reproject(prism.space, step_along(prism.space, ray, ray.c * t), out);
  out.z = surface == kCeiling ? prism.height : 0;
  out.m = -ray.m;
  out.t_min = 0;
  if (t > 0) out.start_wall = -1;
  return out;
}

namespace {

/// cosκ and sinκ of the arc along the wall, times the cosκ of the distance from it. In: no E².
std::array<double, 2> coordinates_on_wall(Space space, const room::Wall& wall, const Point& x) {
  const double k = geometry::curvature(space);
  return {wall.start.w * x.w + k * (wall.start.x * x.x + wall.start.y * x.y),
          k * wall.along.w * x.w + wall.along.x * x.x + wall.along.y * x.y};
}

}  // namespace

double tan_on_wall(Space space, const room::Wall& wall, const Point& x) {
  if (space == Space::euclidean) return (x.x - wall.start.x) * wall.along.x + (x.y - wall.start.y) * wall.along.y;
  const auto [p, v] = coordinates_on_wall(space, wall, x);
  return v / p;
}

double arc_on_wall(Space space, const room::Wall& wall, const Point& x) {
  if (space != Space::spherical) return geometry::atan_k(space, tan_on_wall(space, wall, x));
  const auto [p, v] = coordinates_on_wall(space, wall, x);
  const double s = math::atan2(v, p);
  return s < 0 && wall.length > std::numbers::pi + 1e-6 ? s + 2 * std::numbers::pi : s;
}

Direction normal_of_wall(Space space, const room::Wall& wall) {
  return {{geometry::curvature(space) * wall.line.w, wall.line.x, wall.line.y}, 0};
}

}  // namespace orbc::trace
