#include "compiler/geometry/circle.h"

#include <algorithm>

namespace orbc::geometry {

Circle bounding_circle(Space space, const std::vector<Point>& points) {
  Circle circle;
  if (points.empty()) return circle;
  Ambient sum{0, 0, 0};
  for (const Point& p : points) sum = sum + p;
  constexpr double kBalanced = 1e-6;  // squared length of the sum
  if (space != Space::spherical || sum.w * sum.w + sum.x * sum.x + sum.y * sum.y > kBalanced) circle.centre = normalised_point(space, sum);
  for (const Point& p : points) circle.radius = std::max(circle.radius, distance(space, circle.centre, p));
  return circle;
}

}  // namespace orbc::geometry
