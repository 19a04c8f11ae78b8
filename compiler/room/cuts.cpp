#include "compiler/room/cuts.h"

#include <cmath>

#include "compiler/room/polygon.h"

namespace orbc::room {
namespace {

using geometry::Line;
using geometry::Space;

/// The line at right angles to both; NaN for lines that meet.
Line common_perpendicular(const Line& u, const Line& v) {
  const Line cross{u.x * v.y - u.y * v.x, u.y * v.w - u.w * v.y, u.w * v.x - u.x * v.w};
  return geometry::normalised_line(Space::hyperbolic, {-cross.w, cross.x, cross.y});
}

}  // namespace

std::vector<CutSegment> cut_segments(const Room& room) {
  const int walls = static_cast<int>(room.walls.size());
  if (room.space != Space::hyperbolic || walls < 4) return {};
  const Result<std::vector<scene::Cut>> cuts = complete_cuts(walls, {}, 1);
  if (!cuts) return {};
  std::vector<CutSegment> segments;
  for (const scene::Cut& cut : *cuts) {
    const int first = cut.walls[0] - 1, second = cut.walls[1] - 1;
    const Line &u = room.walls[static_cast<std::size_t>(first)].line, &v = room.walls[static_cast<std::size_t>(second)].line;
    const Line across = common_perpendicular(u, v);
    if (!std::isfinite(across.w)) continue;
    segments.push_back(
        {{first, second}, geometry::intersection(Space::hyperbolic, across, u), geometry::intersection(Space::hyperbolic, across, v)});
  }
  return segments;
}

}  // namespace orbc::room
