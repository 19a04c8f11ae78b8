// The stream of enumerate.h comes depth first, so words of one length come in their order: one bucket for each number of bounces sorts
// them.
#include "compiler/cover/unfold.h"

#include <algorithm>
#include <iterator>

#include "compiler/cover/beam.h"
#include "compiler/cover/plan.h"
#include "compiler/cover/reach.h"
#include "compiler/cover/storeys.h"

namespace orbc::cover {
namespace {

Copy copy_of(const Reach& reach, const Element& element, const geometry::Isometry& cover_from_room, int bounces, int sheet) {
  Copy copy;
  copy.cover_from_room = cover_from_room;
  copy.bounces = bounces;
  copy.sheet = sheet;
  copy.weight = reach.weight[static_cast<std::size_t>(bounces)];
  copy.word.reserve(element.word.size());
  for (const std::uint8_t letter : element.word) copy.word.push_back(static_cast<std::uint8_t>(reach.wall[letter]));
  for (std::size_t letter = 0; letter < reach.wall.size() && reach.wall[letter] < 64; ++letter) {
    // On odd sheets the eye comes from the far side.
    const bool descent = (element.descents >> letter) & 1;
    if (descent != (sheet % 2 == 1)) copy.nearer_walls |= std::uint64_t{1} << reach.wall[letter];
  }
  return copy;
}

Result<std::vector<Copy>> unfold_by_group(const place::PlacedRoom& room, const place::Eye& eye, const scene::CoverSpec& spec,
                                          const UnfoldOptions& options) {
  auto reach = reach_of(room, spec);
  if (!reach) return reach.error();
  std::vector<std::vector<Copy>> by_bounces(static_cast<std::size_t>(reach->max_bounces) + 1);
  std::uint64_t count = 0;
  for (int sheet = 0; sheet < reach->sheets; ++sheet) {
    walk_reach(*reach, room, eye, [&](const Element& element, const geometry::Isometry& cover_from_room) {
      const int bounces = bounces_on(*reach, static_cast<int>(element.word.size()), sheet);
      if (bounces > reach->max_bounces) return Walk::deeper;
      if (count % 65536 == 0) report(options.progress, "unfolding", count, 0, "copies");
      if (++count > options.max_copies) return Walk::stop;
      by_bounces[static_cast<std::size_t>(bounces)].push_back(copy_of(*reach, element, cover_from_room, bounces, sheet));
      return Walk::deeper;
    });
    if (count > options.max_copies) return too_many_copies(room, eye, spec, options.max_copies);
  }
  std::vector<Copy> copies;
  copies.reserve(count);
  for (auto& bucket : by_bounces) {
    std::move(bucket.begin(), bucket.end(), std::back_inserter(copies));
    std::vector<Copy>().swap(bucket);
  }
  return copies;
}

}  // namespace

Result<std::vector<Copy>> unfold(const place::PlacedRoom& room, const place::Eye& eye, const scene::CoverSpec& spec,
                                 const UnfoldOptions& options) {
  auto copies = needs_beams(room)
                    ? unfold_by_beams(room, eye, spec, {std::min(options.max_copies, BeamOptions().max_beams), options.progress})
                    : unfold_by_group(room, eye, spec, options);
  if (!copies || !has_storeys(room)) return copies;
  return stacked(std::move(copies).value(), room, spec, options.max_copies);
}

}  // namespace orbc::cover
