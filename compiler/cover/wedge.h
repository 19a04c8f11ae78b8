#pragma once
#include <cmath>

#include "compiler/geometry/point.h"

namespace orbc::cover {

/// A unit direction on the floor as seen from the eye, in eye coordinates. As a border it stands for the upright plane through the eye
/// along it: the covector (0, −y, x), positive to the left. The eye lies on all these planes, so bending keeps them flat.
struct Bearing {
  double x = 1, y = 0;
};

/// sin of the angle from `a` to `b` (times the length of b): positive when b lies to the left of a.
[[nodiscard]] inline double turn(const Bearing& a, const Bearing& b) { return a.x * b.y - a.y * b.x; }
[[nodiscard]] inline double turn(const Bearing& a, const geometry::Ambient& seen) { return a.x * seen.y - a.y * seen.x; }
[[nodiscard]] inline bool ahead(const Bearing& a, const Bearing& b) { return a.x * b.x + a.y * b.y > 0; }
[[nodiscard]] inline bool same(const Bearing& a, const Bearing& b) { return a.x == b.x && a.y == b.y; }

/// The directions from `from` counter-clockwise to `to`, less than half a turn. Neighbouring wedges store their common border bit by bit
/// alike.
struct Wedge {
  Bearing from, to;
};

}  // namespace orbc::cover
