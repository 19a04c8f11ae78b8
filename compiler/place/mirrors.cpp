#include <fmt/format.h>

#include <cmath>

#include "compiler/place/furnish.h"
#include "compiler/place/locate.h"

namespace orbc::place {
namespace {

PlacedMirror make_mirror(const scene::Mirror& mirror, int wall) {
  PlacedMirror placed;
  placed.wall = wall;
  placed.throughput = mirror.reflectance * mirror.tint;
  placed.emission = mirror.emission;
  return placed;
}

}  // namespace

ClippedMirrors clipped_mirrors(const scene::RoomSpec& spec, const room::Room& room) {
  ClippedMirrors result;
  for (std::size_t i = 0; i < room.walls.size() && i < spec.walls.size(); ++i) {
    if (!room.walls[i].reflects) continue;
    const double length = room.walls[i].length;
    for (const scene::Mirror& mirror : spec.walls[i].mirrors) {
      PlacedMirror placed = make_mirror(mirror, static_cast<int>(i));
      placed.span[0] = mirror.arc ? std::fmax(0, (*mirror.arc)[0]) : 0;
      placed.span[1] = mirror.arc ? std::fmin(length, (*mirror.arc)[1]) : length;
      placed.height[0] = mirror.height ? std::fmax(0, (*mirror.height)[0]) : 0;
      placed.height[1] = mirror.height ? std::fmin(spec.height, (*mirror.height)[1]) : spec.height;
      if (placed.span[0] < placed.span[1] && placed.height[0] < placed.height[1]) {
        result.mirrors.push_back(placed);
        result.sources.push_back(&mirror);
      } else {
        result.warnings.push_back(make_warning("place.mirror-outside-wall", fmt::format("this mirror has no part on wall {}", i + 1),
                                               fmt::format("the wall is {} long and {} high", to_text(length), to_text(spec.height)),
                                               mirror.span));
      }
    }
  }
  if (spec.floor.mirror) {
    result.mirrors.push_back(make_mirror(*spec.floor.mirror, -1));
    result.sources.push_back(&*spec.floor.mirror);
  }
  if (spec.ceiling.mirror) {
    result.mirrors.push_back(make_mirror(*spec.ceiling.mirror, -2));
    result.sources.push_back(&*spec.ceiling.mirror);
  }
  return result;
}

}  // namespace orbc::place
