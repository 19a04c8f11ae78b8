#pragma once
#include <functional>
#include <vector>

#include "compiler/bend/bend.h"
#include "compiler/cover/plan.h"
#include "compiler/cover/sample.h"

namespace orbc::driver {

/// Bends some of the copies, as compiling would.
using BendSome = std::function<Result<bend::BentCover>(const std::vector<std::size_t>& which)>;

/// Foresees what bending will make of copies that are unfolded: triangles, vertices and bytes, from a sample of them that is bent for the
/// purpose.
/// In:          all copies, and what they are drawn from; how to bend some; `max_bytes` allowed; how many triangles may be bent for it,
///              before splitting (at least 128 copies are).
/// Makes:       a plan whose counts of copies are exact, the others extrapolated: within 20 % of what is made. Up to 128 copies are all
///              bent: then it is exact.
/// Diagnostics: cover.too-much when the product would exceed `max_bytes`: the hint names the largest max_bounces that fits; those of
///              `bend_some`.
[[nodiscard]] Result<cover::Plan> estimate(const cover::Contents& contents, const place::Camera& eye,
                                           const std::vector<cover::Copy>& copies, int max_bounces, std::uint64_t max_bytes,
                                           const BendSome& bend_some, std::uint64_t most_triangles = 4'000'000);

}  // namespace orbc::driver
