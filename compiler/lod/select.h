#pragma once
#include <cstdint>
#include <vector>

#include "compiler/bend/screen_size.h"
#include "compiler/cover/copy.h"
#include "compiler/lod/lods.h"

namespace orbc::lod {

/// The levels from which copies are drawn. Copies with the same levels share an entry.
struct LodSelection {
  std::vector<std::vector<std::uint16_t>> levels_of_model;  ///< [model][part of the room]; all models differ; at least one
  std::vector<std::uint32_t> model_of_copy;                 ///< index into levels_of_model
  double error_px = 0;                                      ///< bound of the displacements by coarser levels in the picture
};

/// Selects for each copy and part the coarsest level whose displacement stays within `options.tolerance_px`.
[[nodiscard]] LodSelection select_lods(const InteriorWithLods& lods, const std::vector<cover::Copy>& copies, const place::Camera& eye,
                                       const bend::BendOptions& options);

/// Selects level 0 of all parts for all copies.
[[nodiscard]] LodSelection full_detail(const InteriorWithLods& lods, std::size_t copies);

/// The size of a selection before bending.
struct LodStats {
  std::vector<int> level_of_copy;     ///< the coarsest level among the parts of each copy
  std::uint64_t triangles = 0;        ///< of all copies
  std::uint64_t triangles_saved = 0;  ///< against full detail
};
[[nodiscard]] LodStats lod_stats(const InteriorWithLods& lods, const LodSelection& selection);

/// A cheap stand-in for questions about the whole room: each part at its coarsest level within `max_offset` (intrinsic length), without
/// textures.
[[nodiscard]] place::Interior coarse_proxy(const InteriorWithLods& lods, double max_offset);

}  // namespace orbc::lod
