#include "compiler/place/shared_wall_points.h"

#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"

namespace orbc::place {

using geometry::Point;
using geometry::Space;

double arc_on_wall(const room::Room& room, int index, const Point& x) {
  const room::Wall& wall = room.walls[index];
  if (room.space != Space::spherical) return std::fmin(geometry::distance(room.space, wall.start, x), wall.length);
  const double c = wall.start.w * x.w + wall.start.x * x.x + wall.start.y * x.y;
  double s = math::atan2(wall.along.w * x.w + wall.along.x * x.x + wall.along.y * x.y, c);
  if (s < -1e-9) s += 2 * std::numbers::pi;
  return std::fmin(std::fmax(s, 0), wall.length);
}

SharedWallPoints::SharedWallPoints(const room::Room& room, int wall) : room_(room), wall_(wall), tolerance_(1e-9 * room.circumradius) {
  const std::size_t n = room.outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (room.outline_wall[i] != wall) continue;
    const double length = room.walls[wall].length;
    const auto add = [&](const Point& x, bool is_end) {
      double s = arc_on_wall(room, wall, x);
      if (s < tolerance_) s = is_end ? length : 0;
      if (length - s < tolerance_) s = length;
      if (points_.try_emplace(s, x).second) outline_keys_.push_back(s);
    };
    add(room.outline[i], false);
    add(room.outline[(i + 1) % n], true);
  }
}

const double* SharedWallPoints::known_key(double s) const {
  const auto after = points_.lower_bound(s - tolerance_);
  return after != points_.end() && after->first <= s + tolerance_ ? &after->first : nullptr;
}

double SharedWallPoints::key(double s) {
  if (const double* known = known_key(s)) return *known;
  points_.emplace(s, room::point_on_wall(room_, wall_, s));
  return s;
}

double SharedWallPoints::key(const Point& x) {
  const double s = arc_on_wall(room_, wall_, x);
  if (const double* known = known_key(s)) return *known;
  points_.emplace(s, x);
  return s;
}

std::vector<SharedWallPoints> shared_wall_points(const room::Room& room) {
  std::vector<SharedWallPoints> wall_points;
  for (std::size_t i = 0; i < room.walls.size(); ++i) wall_points.emplace_back(room, static_cast<int>(i));
  return wall_points;
}

}  // namespace orbc::place
