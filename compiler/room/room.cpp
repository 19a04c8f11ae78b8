#include "compiler/room/room.h"

#include <cmath>

#include "compiler/base/elementary.h"

namespace orbc::room {

using geometry::Point;
using geometry::Space;
using geometry::Tangent;

Point point_on_wall(const Room& room, int wall, double s) {
  // Measured from F, the point of the wall nearest to the origin, where no coordinate is large. From a far corner cosκ s·P + sinκ s·V would
  // cancel.
  const Wall& w = room.walls[static_cast<std::size_t>(wall)];
  const double h = math::hypot(w.line.x, w.line.y);
  if (h < 1e-8) return geometry::point_along(room.space, w.start, w.along, s);  // an equator has no nearest point
  const double x = w.line.x / h, y = w.line.y / h;
  const Point foot(room.space == Space::euclidean ? 1 : h, -w.line.w * x, -w.line.w * y);
  const Tangent along(0, y, -x);
  const double ahead = w.start.x * along.x + w.start.y * along.y;
  const double start = room.space == Space::spherical ? math::atan2(ahead, foot.w * w.start.w + foot.x * w.start.x + foot.y * w.start.y)
                                                      : geometry::asin_k(room.space, ahead);
  return geometry::point_along(room.space, foot, along, start + s);
}

geometry::Isometry reflection_in_wall(const Room& room, int wall) {
  return geometry::reflection(room.space, room.walls[static_cast<std::size_t>(wall)].line);
}

std::vector<geometry::Isometry> generators(const Room& room) {
  std::vector<geometry::Isometry> mirrors;
  for (std::size_t i = 0; i < room.walls.size(); ++i)
    if (room.walls[i].reflects) mirrors.push_back(reflection_in_wall(room, static_cast<int>(i)));
  return mirrors;
}

}  // namespace orbc::room
