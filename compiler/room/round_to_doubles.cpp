#include "compiler/room/round_to_doubles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/geometry/predicates.h"

namespace orbc::room {
namespace {

using geometry::Point;
using geometry::Space;

constexpr double kLongWallRadians = 2;  // radians of S²; orbifolds with corners reach π/2 at most, lunes π

// What 168 bits of working precision leave of an exact zero becomes one.
double rounded(const Real& value, const Real& scale) { return abs(value) <= ldexp(scale, -140) ? 0 : static_cast<double>(value); }

struct Rounded {
  double w, x, y;
};
Rounded rounded(const RealVector& v) {
  const Real scale = abs(v.w) + abs(v.x) + abs(v.y);
  return {rounded(v.w, scale), rounded(v.x, scale), rounded(v.y, scale)};
}

// The direction of travel at a point of the line, which has the inside to its left.
RealVector direction_at(int k, const RealVector& line, const RealVector& at) {
  const RealVector normal{k * line.w, line.x, line.y};
  const RealVector t = cross(at, normal);
  return {-k * t.w, -t.x, -t.y};
}

// A point between the ends of a long wall. Rounding may put it an ulp inside the chord of its neighbours, which would dent the border;
// it is pushed out until the exact predicate is content.
Point between(const RealVector& start, const RealVector& along, const RealVector& line, const Real& s, const Point& before,
              const Point& after) {
  const RealVector m = cos(s) * start + sin(s) * along;
  const Rounded exact = rounded(m);
  Point point(exact.w, exact.x, exact.y);
  const double nw = static_cast<double>(line.w), nx = static_cast<double>(line.x), ny = static_cast<double>(line.y);
  for (double out = 0x1p-54; geometry::side_of(before, point, after) == geometry::Side::right; out *= 2)
    point = {exact.w - out * nw, exact.x - out * nx, exact.y - out * ny};
  return point;
}

}  // namespace

Room round_to_doubles(const Polygon& polygon, const std::vector<CornerAngle>& angles) {
  Room room;
  room.space = polygon.space;
  const int k = geometry::curvature(polygon.space);
  const std::size_t n = polygon.corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Rounded at = rounded(polygon.corners[i]);
    room.corners.push_back({Point(at.w, at.x, at.y), static_cast<double>(angles[i].angle)});
    room.circumradius = std::max(room.circumradius, geometry::distance(room.space, Point(), room.corners.back().at));
  }
  for (std::size_t i = 0; i < n; ++i) {
    const RealVector &line = polygon.lines[i], &start = polygon.corners[i];
    const RealVector along = direction_at(k, line, start);
    const Real length = n == 2 ? real_pi() : side_length(polygon, i);
    const Rounded l = rounded(line), t = rounded(along);
    room.walls.push_back({{l.w, l.x, l.y}, room.corners[i].at, {t.w, t.x, t.y}, static_cast<double>(length), true});
    room.outline.push_back(room.corners[i].at);
    room.outline_wall.push_back(static_cast<int>(i));
    if (k > 0 && length > kLongWallRadians) {
      room.outline.push_back(between(start, along, line, length / 2, room.corners[i].at, room.corners[(i + 1) % n].at));
      room.outline_wall.push_back(static_cast<int>(i));
    }
  }
  room.inradius = static_cast<double>(polygon.inradius);
  return room;
}

Room hemisphere() {
  Room room;
  room.space = Space::spherical;
  room.outline = {{0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {0, 0, -1}};
  room.outline_wall = {0, 0, 0, 0};
  room.walls = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 2 * std::numbers::pi, true}};
  room.inradius = room.circumradius = std::numbers::pi / 2;
  return room;
}

}  // namespace orbc::room
