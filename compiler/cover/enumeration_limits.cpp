// A reduced word crosses each of its mirrors once and for good. So all continuations of a word lie behind its last mirror, and may be left
// out as soon as a copy at the distance of that mirror would be too small. On S² nothing becomes small.
#include "compiler/cover/enumeration_limits.h"

#include <algorithm>
#include <cmath>

#include "compiler/cover/beam.h"
#include "compiler/cover/projected_size.h"
#include "compiler/notation/growth.h"
#include "compiler/room/room.h"

namespace orbc::cover {
namespace {

using geometry::Isometry;
using geometry::Point;
using geometry::Space;

bool contains(const std::vector<bool>& flags, bool value) { return std::find(flags.begin(), flags.end(), value) != flags.end(); }

std::vector<scene::Color> weights_within(const scene::Color& throughput, const scene::CoverSpec& spec) {
  std::vector<scene::Color> weights{{1, 1, 1}};
  while (static_cast<int>(weights.size()) <= std::max(0, spec.max_bounces)) {
    const scene::Color next = weights.back() * throughput;
    if (max_channel(next) < spec.min_weight) break;
    weights.push_back(next);
  }
  return weights;
}

}  // namespace

EnumerationLimits enumeration_limits(const place::Interior& room, const scene::CoverSpec& spec) {
  ORBC_CHECK(needs_beams(room), ==, false);
  EnumerationLimits limits;
  for (std::size_t i = 0; i < room.polygon.walls.size(); ++i)
    if (room.polygon.walls[i].reflects) limits.wall_of_letter.push_back(static_cast<int>(i));
  limits.has_mirror.assign(limits.wall_of_letter.size(), false);
  for (const int wall : limits.wall_of_letter) limits.reflections.push_back(room::reflection_in_wall(room.polygon, wall));
  const place::PlacedMirror* first = nullptr;
  for (const place::PlacedMirror& mirror : room.mirrors) {
    if (mirror.wall < 0) continue;  // on floor or ceiling
    const auto letter = std::find(limits.wall_of_letter.begin(), limits.wall_of_letter.end(), mirror.wall);
    if (letter == limits.wall_of_letter.end()) continue;  // end walls of a strip have no mirrors
    limits.has_mirror[static_cast<std::size_t>(letter - limits.wall_of_letter.begin())] = true;
    if (!first) first = &mirror;
  }
  if (first) limits.weight_by_bounces = weights_within(first->throughput, spec);
  else limits.weight_by_bounces = {{1, 1, 1}};
  limits.max_bounces = static_cast<int>(limits.weight_by_bounces.size()) - 1;
  limits.min_pixels = spec.min_pixels;
  if (room.polygon.space == Space::spherical) {
    limits.bounces_per_half_turn = notation::longest_length(room.polygon.orbifold).value();
    // Every half turn passes all walls. So one plain wall hides all sheets but the first.
    limits.sheets = contains(limits.has_mirror, false) ? 1 : limits.max_bounces / limits.bounces_per_half_turn + 1;
  }
  return limits;
}

int bounces_on_sheet(const EnumerationLimits& limits, int length, int sheet) {
  return sheet % 2 == 0 ? sheet * limits.bounces_per_half_turn + length : (sheet + 1) * limits.bounces_per_half_turn - length;
}

void visit_copies(const EnumerationLimits& limits, const place::Interior& room, const place::Camera& eye,
                  const std::function<Visit(const Element&, const Isometry&)>& visit) {
  // Later sheets need the whole group, whatever its bounces on sheet 0.
  const int half_turn = limits.bounces_per_half_turn;
  const int longest = limits.sheets > 1 ? half_turn : half_turn > 0 ? std::min(half_turn, limits.max_bounces) : limits.max_bounces;
  if (!contains(limits.has_mirror, true)) {
    visit(Element{}, geometry::identity(room.polygon.space));
    return;
  }
  const Automaton automaton(room.polygon.orbifold, std::max(longest, 1));
  const Point eye_in_cover = eye.room_from_eye * Point();
  const Space space = room.polygon.space;
  const ProjectedSize size(room, eye);
  enumerate(automaton, limits.reflections, longest, [&](const Element& element, const Isometry& cover_from_room) -> Visit {
    if (element.word.empty()) return visit(element, cover_from_room);
    const std::size_t last = element.word.back();
    if (!limits.has_mirror[last]) return Visit::prune;
    if (limits.min_pixels > 0 && space != Space::spherical) {
      const Point here = inverse(cover_from_room) * eye_in_cover;
      const auto& line = room.polygon.walls[static_cast<std::size_t>(limits.wall_of_letter[last])].line;
      if (size.at(std::fabs(geometry::signed_distance(space, line, here))) < limits.min_pixels) return Visit::prune;
      if (size.of(cover_from_room) < limits.min_pixels) return Visit::descend;
    }
    return visit(element, cover_from_room);
  });
}

}  // namespace orbc::cover
