#include "compiler/cover/rim.h"

#include <algorithm>

#include "compiler/cover/storeys.h"
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

/// The mirror of a wall at arc length s and height z: the first one there, as in the tracer.
const place::PlacedMirror* mirror_at(const place::PlacedRoom& room, int wall, double s, double z) {
  for (const place::PlacedMirror& mirror : room.mirrors)
    if (mirror.wall == wall && mirror.span[0] < s && s < mirror.span[1] && mirror.height[0] < z && z < mirror.height[1]) return &mirror;
  return nullptr;
}

/// A mirror or a row of them that reflect alike, from its lowest height to its highest.
struct Pane {
  int loss = 0;
  double low = 0, high = 0;
};

void append(std::vector<Pane>& panes, const Pane& pane) {
  if (panes.empty() || panes.back().loss != pane.loss) return panes.push_back(pane);
  panes.back().high = pane.high;
}

std::vector<Pane> panes_at(const place::PlacedRoom& room, int wall, double s, std::vector<scene::Color>& losses) {
  std::vector<double> heights;
  for (const place::PlacedMirror& mirror : room.mirrors)
    if (mirror.wall == wall && mirror.span[0] < s && s < mirror.span[1])
      heights.insert(heights.end(), {mirror.height[0], mirror.height[1]});
  std::sort(heights.begin(), heights.end());
  std::vector<Pane> panes;
  for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
    if (!(heights[i] < heights[i + 1])) continue;
    if (const auto* mirror = mirror_at(room, wall, s, (heights[i] + heights[i + 1]) / 2))
      append(panes, {loss_index(losses, mirror->reflectance * mirror->tint), heights[i], heights[i + 1]});
  }
  return panes;
}

/// The panes on all storeys; z ↦ sign·z + offset turns every other one upside down.
std::vector<Pane> on_storeys(const std::vector<Pane>& panes, std::vector<WeightedStorey> storeys) {
  std::sort(storeys.begin(), storeys.end(),
            [](const WeightedStorey& a, const WeightedStorey& b) { return a.storey.number < b.storey.number; });
  std::vector<Pane> all;
  for (const WeightedStorey& on : storeys) {
    const auto lifted = [&](double z) { return on.storey.sign * z + on.storey.offset; };
    for (std::size_t i = 0; i < panes.size(); ++i) {
      const Pane& pane = panes[on.storey.sign > 0 ? i : panes.size() - 1 - i];
      append(all, {pane.loss, std::min(lifted(pane.low), lifted(pane.high)), std::max(lifted(pane.low), lifted(pane.high))});
    }
  }
  return all;
}

/// Mirrors that do not reach floor or ceiling leave plain wall, which hides what is behind: only where they differ are rays told apart.
std::vector<Opening> openings_at(const place::PlacedRoom& room, int wall, double s, int max_bounces, std::vector<scene::Color>& losses) {
  std::vector<Pane> panes = panes_at(room, wall, s, losses);
  if (panes.size() > 1) panes = on_storeys(panes, storeys_of(room, max_bounces));
  std::vector<Opening> openings;
  for (const Pane& pane : panes) openings.push_back({pane.loss});
  for (std::size_t i = 0; i + 1 < panes.size(); ++i)
    openings[i].to = openings[i + 1].from = panes[i].high + (panes[i + 1].low - panes[i].high) / 2;
  return openings;
}

}  // namespace

Rim make_rim(const place::PlacedRoom& placed, int max_bounces) {
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
      rim.points.push_back(places[i].at);
      rim.edges.push_back({wall, openings_at(placed, wall, (places[i].s + next) / 2, max_bounces, rim.losses)});
    }
  }
  return rim;
}

}  // namespace orbc::cover
