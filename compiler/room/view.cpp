#include "compiler/room/view.h"
#include "compiler/base/elementary.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace orbc::room {
namespace {

constexpr double kBeside = 20;      // degrees between the corner and the view: a quarter of a usual field of view

double azimuth(const geometry::Point& p) { return math::atan2(p.y, p.x) * 180 / std::numbers::pi; }

}  // namespace

double view_direction(const Room& room) {
  if (room.corners.empty()) return 0;
  double view = 0;
  if (room.orbifold.strip) {
    view = azimuth(point_on_wall(room, 2, room.walls[2].length / 2)) + kBeside / 3;
  } else {
    std::vector<std::size_t> order(room.corners.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    constexpr double kSame = 1e-9;  // radians: angles of equal corners differ by rounding, and the first of them shall come first
    std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
      return std::round(room.corners[i].angle / kSame) > std::round(room.corners[j].angle / kSame);
    });
    view = azimuth(room.corners[order[1]].at) - kBeside;
  }
  view = std::fmod(view, 360);
  return view < 0 ? view + 360 : view;
}

}  // namespace orbc::room
