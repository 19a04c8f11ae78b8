#include "compiler/cover/beam_hits.h"

#include <algorithm>
#include <tuple>

#include "compiler/base/elementary.h"
#include "compiler/notation/euler.h"
#include "compiler/room/room.h"

namespace orbc::cover {
namespace {

using geometry::Isometry;

constexpr double kMinSineOfJoinedWedge = 1e-6;  // joined wedges stay below half a turn

Copy copy_of(const BeamHit& hit, const Reflections& reflections, const std::vector<scene::Color>& throughputs) {
  Copy copy;
  copy.cover_from_room = hit.cover_from_room;
  copy.bounces = hit.bounces;
  copy.sheet = hit.sheet;
  copy.weight = weight_of(hit.crossings, throughputs);
  copy.eye_facing_walls = hit.eye_facing_walls;
  copy.word = hit.word;
  if (!reflections.automaton) return copy;
  const std::vector<int>& wall_of_letter = reflections.wall_of_letter;
  for (std::uint8_t& letter : copy.word) letter = static_cast<std::uint8_t>(wall_of_letter[letter]);
  const std::uint64_t nearer = descents(*reflections.automaton, hit.word);
  copy.eye_facing_walls = 0;
  for (std::size_t letter = 0; letter < wall_of_letter.size() && letter < 64; ++letter) {
    if (((nearer >> letter) & 1) != (hit.sheet % 2 == 1)) copy.eye_facing_walls |= wall_bit(wall_of_letter[letter]);
  }
  return copy;
}

auto element_of(const BeamHit& hit) { return std::tie(hit.bounces, hit.sheet, hit.word); }

bool is_before(const BeamHit& a, const BeamHit& b) {
  const double x = math::atan2(a.wedge.from.y, a.wedge.from.x), y = math::atan2(b.wedge.from.y, b.wedge.from.x);
  return std::tie(a.bounces, a.sheet, a.word, a.crossings, x) < std::tie(b.bounces, b.sheet, b.word, b.crossings, y);
}

/// Whether `next` shows the same as `first` in a wedge that begins where the given one ends.
bool continues(const BeamHit& first, const Wedge& wedge, const BeamHit& next) {
  if (!first.height_bounds.empty() || !next.height_bounds.empty()) return false;
  return first.crossings == next.crossings && first.eye_facing_walls == next.eye_facing_walls && wedge.to == next.wedge.from &&
         cross(wedge.from, next.wedge.to) > kMinSineOfJoinedWedge;
}

}  // namespace

Reflections reflections_of(const place::Interior& room, int max_length) {
  Reflections reflections;
  const int walls = static_cast<int>(room.polygon.walls.size());
  for (int wall = 0; wall < walls; ++wall) reflections.in_wall.push_back(room::reflection_in_wall(room.polygon, wall));
  reflections.letter_of_wall.assign(static_cast<std::size_t>(walls), -1);
  if (!notation::is_orbifold(room.polygon.orbifold)) return reflections;
  reflections.automaton.emplace(room.polygon.orbifold, std::max(1, max_length));
  for (int wall = 0; wall < walls; ++wall) {
    if (!room.polygon.walls[static_cast<std::size_t>(wall)].reflects) continue;
    reflections.letter_of_wall[static_cast<std::size_t>(wall)] = static_cast<int>(reflections.wall_of_letter.size());
    reflections.wall_of_letter.push_back(wall);
  }
  return reflections;
}

Isometry isometry_of(const Reflections& reflections, const Word& word) {
  // In the order in which `enumerate` multiplies.
  Isometry product = geometry::identity(reflections.in_wall.front().space);
  for (std::size_t i = 0; i < word.size(); ++i) {
    product = product * reflections.in_wall[static_cast<std::size_t>(reflections.wall_of_letter[word[i]])];
    if ((i + 1) % 8 == 0) product = geometry::renormalised(product);
  }
  return product;
}

scene::Color weight_of(const std::vector<std::uint16_t>& crossings, const std::vector<scene::Color>& throughputs) {
  scene::Color weight{1, 1, 1};
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    for (int n = 0; n < crossings[i]; ++n) weight = weight * throughputs[i];
  }
  return weight;
}

std::vector<Copy> copies_of(std::vector<BeamHit> hits, const Reflections& reflections, const std::vector<scene::Color>& throughputs,
                            bool all_found) {
  std::vector<Copy> copies;
  std::sort(hits.begin(), hits.end(), is_before);
  for (std::size_t first = 0, end = 0; first < hits.size(); first = end) {
    for (end = first + 1; end < hits.size() && element_of(hits[first]) == element_of(hits[end]);) ++end;
    const bool one_weight = hits[first].crossings == hits[end - 1].crossings;
    if (reflections.automaton && one_weight && all_found) {
      // Bearings without a hit are those of plain walls, which hide the copy there.
      copies.push_back(copy_of(hits[first], reflections, throughputs));
      continue;
    }
    for (std::size_t i = first; i < end;) {
      Copy copy = copy_of(hits[i], reflections, throughputs);
      copy.wedge = hits[i].wedge;
      copy.height_bounds = hits[i].height_bounds;
      const std::size_t run = i;
      for (++i; i < end && continues(hits[run], *copy.wedge, hits[i]); ++i) copy.wedge->to = hits[i].wedge.to;
      copies.push_back(std::move(copy));
    }
  }
  return copies;
}

}  // namespace orbc::cover
