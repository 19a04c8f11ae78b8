#pragma once
#include <vector>

#include "compiler/geometry/point.h"

namespace orbc::geometry {

/// A circle on the floor.
struct Circle {
  Point centre;
  double radius = 0;  ///< arc length
};

/// A circle around points: its centre is the normalised sum of the points. On S², where points may balance each other (those of a whole
/// equator), the centre is then the origin.
/// Makes: a circle of radius 0 at the origin when there are no points.
/// Not promised: the smallest circle.
[[nodiscard]] Circle bounding_circle(Space space, const std::vector<Point>& points);

}  // namespace orbc::geometry
