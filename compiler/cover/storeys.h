#pragma once
#include <cstdint>
#include <vector>

#include "compiler/base/result.h"
#include "compiler/cover/copy.h"
#include "compiler/place/interior.h"

namespace orbc::cover {

/// A storey with the product of the throughputs of the mirrors between it and the room.
struct WeightedStorey {
  Storey storey;
  scene::Color weight{1, 1, 1};
};

/// Whether floor or ceiling is a mirror.
[[nodiscard]] bool has_storeys(const place::Interior& room);

/// All storeys within `max_bounces` mirrors, in the order 0, 1, −1, 2, −2, …; storey 0 alone when neither floor nor ceiling is a mirror.
/// Formula: storey n maps the height z to z + nh for even n, and to (n + 1)h − z for odd n, where h is the height of the room. Paths
///          upwards pass the ceiling first, then floor and ceiling in turn.
[[nodiscard]] std::vector<WeightedStorey> storeys_within(const place::Interior& room, int max_bounces);

/// Puts every copy on every storey. Bounces add up and weights multiply: they do not depend on the order in which a ray meets its mirrors.
/// Makes:       copies by bounces; for one number of bounces in the given order, then by storey. Limits of `spec` are applied.
/// Diagnostics: cover.too-much beyond `max_copies`.
[[nodiscard]] Result<std::vector<Copy>> with_storeys(const std::vector<Copy>& copies, const place::Interior& room,
                                                     const scene::CoverSpec& spec, std::uint64_t max_copies);

}  // namespace orbc::cover
