#pragma once
#include <cstdint>
#include <vector>

#include "compiler/base/result.h"
#include "compiler/cover/copy.h"
#include "compiler/place/placed.h"

namespace orbc::cover {

/// One storey that mirrors on floor and ceiling make, with the weight of the mirrors on the way to it.
struct WeightedStorey {
  Storey storey;
  scene::Color weight{1, 1, 1};
};

[[nodiscard]] bool has_storeys(const place::PlacedRoom& room);

/// All storeys within `max_bounces` mirrors: 0, 1, −1, 2, −2, …; one alone when neither floor nor ceiling is a mirror.
/// Formula: storey n even: z ↦ z + nh; odd: z ↦ (n + 1)h − z. Up through the ceiling first, then floor and ceiling in turn.
[[nodiscard]] std::vector<WeightedStorey> storeys_of(const place::PlacedRoom& room, int max_bounces);

/// Puts every copy on every storey: bounces add up, weights multiply, whatever the order in which a ray meets walls, floors and ceilings.
/// Makes:       copies by bounces; within one number of bounces the order given, then by storey.
/// Diagnostics: cover.too-much beyond `max_copies`.
[[nodiscard]] Result<std::vector<Copy>> stacked(const std::vector<Copy>& copies, const place::PlacedRoom& room,
                                                const scene::CoverSpec& spec, std::uint64_t max_copies);

}  // namespace orbc::cover
