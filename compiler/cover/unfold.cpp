// The enumeration is depth first, so it visits the words of one length in lexicographic order. One bucket for each number of bounces sorts
// the copies.
#include "compiler/cover/unfold.h"

#include <algorithm>
#include <iterator>

#include "compiler/cover/beam.h"
#include "compiler/cover/enumeration_limits.h"
#include "compiler/cover/plan.h"
#include "compiler/cover/storeys.h"

namespace orbc::cover {
namespace {

Copy copy_of(const EnumerationLimits& limits, const Element& element, const geometry::Isometry& cover_from_room, int sheet) {
  Copy copy;
  copy.cover_from_room = cover_from_room;
  copy.bounces = bounces_on_sheet(limits, static_cast<int>(element.word.size()), sheet);
  copy.sheet = sheet;
  copy.weight = limits.weight_by_bounces[static_cast<std::size_t>(copy.bounces)];
  copy.word.reserve(element.word.size());
  for (const std::uint8_t letter : element.word) copy.word.push_back(static_cast<std::uint8_t>(limits.wall_of_letter[letter]));
  for (std::size_t letter = 0; letter < limits.wall_of_letter.size() && limits.wall_of_letter[letter] < 64; ++letter) {
    // On odd sheets the rays come from the eye's antipode.
    const bool descent = (element.descents >> letter) & 1;
    if (descent != (sheet % 2 == 1)) copy.eye_facing_walls |= wall_bit(limits.wall_of_letter[letter]);
  }
  return copy;
}

Result<std::vector<Copy>> unfold_by_group(const place::Interior& room, const place::Camera& eye, const scene::CoverSpec& spec,
                                          const UnfoldOptions& options) {
  const EnumerationLimits limits = enumeration_limits(room, spec);
  std::vector<std::vector<Copy>> by_bounces(static_cast<std::size_t>(limits.max_bounces) + 1);
  std::uint64_t count = 0;
  for (int sheet = 0; sheet < limits.sheets; ++sheet) {
    visit_copies(limits, room, eye, [&](const Element& element, const geometry::Isometry& cover_from_room) {
      const int bounces = bounces_on_sheet(limits, static_cast<int>(element.word.size()), sheet);
      if (bounces > limits.max_bounces) return Visit::descend;
      if (count % 65536 == 0) report(options.progress, "unfolding", count, 0, "copies");
      if (++count > options.max_copies) return Visit::stop;
      by_bounces[static_cast<std::size_t>(bounces)].push_back(copy_of(limits, element, cover_from_room, sheet));
      return Visit::descend;
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

Result<std::vector<Copy>> unfold(const place::Interior& room, const place::Camera& eye, const scene::CoverSpec& spec,
                                 const UnfoldOptions& options) {
  auto copies = needs_beams(room)
                    ? unfold_by_beams(room, eye, spec, {std::min(options.max_copies, BeamOptions().max_beams), options.progress})
                    : unfold_by_group(room, eye, spec, options);
  if (!copies || !has_storeys(room)) return copies;
  return with_storeys(std::move(copies).value(), room, spec, options.max_copies);
}

}  // namespace orbc::cover
