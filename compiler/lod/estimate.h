#pragma once
#include <functional>
#include <vector>

#include "compiler/bend/bend.h"
#include "compiler/cover/plan.h"
#include "compiler/cover/sample.h"

namespace orbc::lod {

/// Bends some of the copies, named by their indices, as compiling would.
using BendSome = std::function<Result<bend::BentCover>(const std::vector<std::size_t>& copies)>;

struct EstimateOptions {
  int max_bounces = 0;                      ///< of the scene, for the message
  std::uint64_t max_bytes = 0;              ///< allowed for the product
  std::uint64_t max_triangles = 4'000'000;  ///< that may be bent for the estimate, counted before splitting; at least 128 copies are bent
};

/// Estimates what bending makes of unfolded copies: triangles, vertices and bytes, from a sample of the copies that is bent.
/// In:          all copies, and the meshes from which they are drawn.
/// Makes:       a plan with the exact number of copies. Its other numbers are extrapolated, within 20 %; exact for up to 128 copies, all of
///              which are bent.
/// Diagnostics: cover.too-much when the product would exceed `max_bytes`: the hint names the largest max_bounces that fits; those of
///              `bend_some`.
[[nodiscard]] Result<cover::Plan> estimate(const cover::Contents& contents, const place::Camera& eye,
                                           const std::vector<cover::Copy>& copies, const BendSome& bend_some,
                                           const EstimateOptions& options);

}  // namespace orbc::lod
