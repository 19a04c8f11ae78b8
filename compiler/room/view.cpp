#include "compiler/room/view.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "compiler/base/elementary.h"

namespace orbc::room {
namespace {

constexpr double kViewOffsetDegrees = 20;  // between the corner and the view: a quarter of a usual field of view

double azimuth(const geometry::Point& p) { return math::atan2(p.y, p.x) * 180 / std::numbers::pi; }

}  // namespace

double view_direction(const Room& room) {
  if (room.corners.empty()) return 0;
  double view = 0;
  if (room.orbifold.strip) {
    view = azimuth(point_on_wall(room, 2, room.walls[2].length / 2)) + kViewOffsetDegrees / 3;
  } else {
    std::vector<std::size_t> order(room.corners.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    constexpr double kSameAngleRadians = 1e-9;  // equal corners may differ by rounding, and must keep their order
    std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
      return std::round(room.corners[i].angle / kSameAngleRadians) > std::round(room.corners[j].angle / kSameAngleRadians);
    });
    view = azimuth(room.corners[order[1]].at) - kViewOffsetDegrees;
  }
  view = std::fmod(view, 360);
  return view < 0 ? view + 360 : view;
}

}  // namespace orbc::room
