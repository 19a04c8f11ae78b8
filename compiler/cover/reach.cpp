// Cut-offs that unfold and plan share. A word goes on only behind the mirrors it has passed (a reduced word crosses each of them for good),
// so a subtree may be left out as soon as a copy at the distance of the last mirror would be too small. On S² nothing gets small, and
// nothing is left out before its visit.
#include "compiler/cover/reach.h"

#include <algorithm>
#include <cmath>

#include "compiler/cover/size.h"
#include "compiler/notation/growth.h"
#include "compiler/room/room.h"

namespace orbc::cover {
namespace {

using geometry::Isometry;
using geometry::Point;
using geometry::Space;

}  // namespace

Result<Reach> reach_of(const place::PlacedRoom& room, const scene::CoverSpec& spec) {
  const auto& orbifold = room.room.orbifold;
  if (!std::all_of(orbifold.corners.begin(), orbifold.corners.end(), is_integer)) {
    return make_error(
        "cover.not-an-orbifold",
        "the copies of this room overlap: a corner is no π/k with an integer k, so each copy is seen only through its chain of mirrors",
        "draw it with the tracer, or use integer corners");
  }
  Reach reach;
  for (std::size_t i = 0; i < room.room.walls.size(); ++i)
    if (room.room.walls[i].reflects) reach.wall.push_back(static_cast<int>(i));
  reach.open.assign(reach.wall.size(), false);
  for (const int wall : reach.wall) reach.mirrors.push_back(room::reflection_in_wall(room.room, wall));
  const place::PlacedMirror* first = nullptr;
  for (const place::PlacedMirror& mirror : room.mirrors) {
    if (mirror.wall < 0) continue;              // storeys.h
    const auto letter = std::find(reach.wall.begin(), reach.wall.end(), mirror.wall);
    if (letter == reach.wall.end()) continue;   // end walls of a strip carry no mirrors
    reach.open[static_cast<std::size_t>(letter - reach.wall.begin())] = true;
    if (!first) first = &mirror;
    const scene::Color a = mirror.reflectance * mirror.tint, b = first->reflectance * first->tint;
    if (a.r != b.r || a.g != b.g || a.b != b.b) {
      return make_error("cover.mixed-mirrors",
                        "the mirrors of walls " + std::to_string(first->wall + 1) + " and " + std::to_string(mirror.wall + 1) +
                            " differ in reflectance or tint: what a copy loses depends on the path to each of its points",
                        "give all mirrors the same reflectance and tint, or draw the scene with the tracer");
    }
  }
  const scene::Color loss = first ? first->reflectance * first->tint : scene::Color{1, 1, 1};
  reach.weight = {{1, 1, 1}};
  const int most = first ? std::max(0, spec.max_bounces) : 0;
  while (static_cast<int>(reach.weight.size()) <= most) {
    const scene::Color next = reach.weight.back() * loss;
    if (largest(next) < spec.min_weight) break;
    reach.weight.push_back(next);
  }
  reach.max_bounces = static_cast<int>(reach.weight.size()) - 1;
  reach.min_pixels = spec.min_pixels;
  if (room.room.space == Space::spherical) {
    reach.half_turn = notation::longest_length(orbifold).value();
    // Every half turn passes all mirrors, plain walls included: behind one there is no second sheet.
    const bool closed = std::find(reach.open.begin(), reach.open.end(), false) != reach.open.end();
    reach.sheets = closed ? 1 : reach.max_bounces / reach.half_turn + 1;
  }
  return reach;
}

int bounces_on(const Reach& reach, int length, int sheet) {
  return sheet % 2 == 0 ? sheet * reach.half_turn + length : (sheet + 1) * reach.half_turn - length;
}

void walk_reach(const Reach& reach, const place::PlacedRoom& room, const place::Eye& eye,
                const std::function<Walk(const Element&, const Isometry&)>& visit) {
  // Later sheets need the whole group, whatever its bounces on sheet 0.
  const int longest = reach.sheets > 1      ? reach.half_turn
                      : reach.half_turn > 0 ? std::min(reach.half_turn, reach.max_bounces)
                                            : reach.max_bounces;
  if (std::find(reach.open.begin(), reach.open.end(), true) == reach.open.end()) {
    visit(Element{}, geometry::identity(room.room.space));
    return;
  }
  const Automaton automaton(room.room.orbifold, std::max(longest, 1));
  const Point eye_in_cover = eye.room_from_eye * Point();
  const Space space = room.room.space;
  const CopySize size(room, eye);
  enumerate(automaton, reach.mirrors, longest, [&](const Element& element, const Isometry& cover_from_room) -> Walk {
    if (element.word.empty()) return visit(element, cover_from_room);
    const std::size_t last = element.word.back();
    if (!reach.open[last]) return Walk::back;
    if (reach.min_pixels > 0 && space != Space::spherical) {
      const Point here = inverse(cover_from_room) * eye_in_cover;
      const auto& line = room.room.walls[static_cast<std::size_t>(reach.wall[last])].line;
      if (size.at(std::fabs(geometry::signed_distance(space, line, here))) < reach.min_pixels) return Walk::back;
      if (size.of(cover_from_room) < reach.min_pixels) return Walk::deeper;
    }
    return visit(element, cover_from_room);
  });
}

}  // namespace orbc::cover
