#include "compiler/cover/rim.h"

#include <algorithm>

#include "compiler/place/panels.h"
#include "compiler/room/room.h"

namespace orbc::cover {
namespace {

constexpr double kSame = 1e-9;   // arc lengths closer than this are one place, as in the tracer and on the panels

int loss_index(std::vector<scene::Color>& losses, const scene::Color& loss) {
  const auto known = std::find(losses.begin(), losses.end(), loss);
  if (known != losses.end()) return static_cast<int>(known - losses.begin());
  losses.push_back(loss);
  return static_cast<int>(losses.size()) - 1;
}

/// The mirror at arc length s of a wall; of mirrors above each other the first, if all are alike or hidden behind it.
Result<int> opening_at(const place::PlacedRoom& room, int wall, double s, std::vector<scene::Color>& losses) {
  const place::PlacedMirror* first = nullptr;
  for (const place::PlacedMirror& mirror : room.mirrors) {
    if (mirror.wall != wall || !(mirror.span[0] < s && s < mirror.span[1]) || !(mirror.height[0] < mirror.height[1])) continue;
    if (!first) {
      first = &mirror;
      continue;
    }
    const bool alike = mirror.reflectance * mirror.tint == first->reflectance * first->tint;
    const bool hidden = mirror.height[0] >= first->height[0] && mirror.height[1] <= first->height[1];
    if (!alike && !hidden) {
      return make_error("cover.stacked-mirrors", "two mirrors of wall " + std::to_string(wall + 1) + " hang above each other and differ in reflectance or tint",
                        "give both the same reflectance and tint, hang them side by side, or draw the scene with the tracer");
    }
  }
  return first ? loss_index(losses, first->reflectance * first->tint) : -1;
}

}  // namespace

Result<Rim> make_rim(const place::PlacedRoom& placed) {
  const room::Room& room = placed.room;
  const std::size_t corners = room.outline.size();
  Rim rim;
  rim.first.assign(room.walls.size(), 0);
  rim.count.assign(room.walls.size(), 0);
  // Begin where a wall begins.
  std::size_t start = 0;
  while (start < corners && room.outline_wall[start] == room.outline_wall[(start + corners - 1) % corners]) ++start;
  if (start == corners) start = 0;   // `*`: one wall
  for (std::size_t k = 0; k < corners;) {
    const int wall = room.outline_wall[(start + k) % corners];
    const double length = room.walls[static_cast<std::size_t>(wall)].length;
    struct Place {
      double s;
      geometry::Point at;
    };
    std::vector<Place> places{{0, room.outline[(start + k) % corners]}};
    for (++k; k < corners && room.outline_wall[(start + k) % corners] == wall; ++k) {
      const geometry::Point& at = room.outline[(start + k) % corners];
      places.push_back({place::arc_on_wall(room, wall, at), at});
    }
    for (const place::PlacedMirror& mirror : placed.mirrors) {
      if (mirror.wall != wall) continue;
      for (const double s : mirror.span) {
        const bool known = std::any_of(places.begin(), places.end(), [&](const Place& p) { return std::abs(p.s - s) < kSame; });
        if (!known && s < length - kSame) places.push_back({s, room::point_on_wall(room, wall, s)});
      }
    }
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.s < b.s; });
    rim.first[static_cast<std::size_t>(wall)] = static_cast<int>(rim.edges.size());
    rim.count[static_cast<std::size_t>(wall)] = static_cast<int>(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double next = i + 1 < places.size() ? places[i + 1].s : length;
      const auto opening = opening_at(placed, wall, (places[i].s + next) / 2, rim.losses);
      if (!opening) return opening.error();
      rim.points.push_back(places[i].at);
      rim.edges.push_back({wall, *opening});
    }
  }
  return rim;
}

}  // namespace orbc::cover
