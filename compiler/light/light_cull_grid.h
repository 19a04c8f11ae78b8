#pragma once
#include <cstdint>
#include <vector>

#include "compiler/base/executor.h"
#include "compiler/geometry/point.h"

namespace orbc::light {

struct LightingContext;

/// A grid of cells over the room with the lamp images that matter in each. In H² and E² most images add nothing visible at most points.
struct LightCullGrid {
  double disk_radius = 0;                                                                       ///< of the room in the disk chart
  double height = 0;                                                                            ///< of the room
  int cells_across = 0, cells_up = 0;                                                           ///< 0: one cell is the whole room
  std::vector<std::vector<std::uint32_t>> images = std::vector<std::vector<std::uint32_t>>(1);  ///< per cell: into LightingContext::images
};
[[nodiscard]] LightCullGrid make_light_cull_grid(const LightingContext& lighting, const Executor& executor);

/// Indices of the images, ascending, that may add light of LightingContext::faint_below, or a highlight of it, at a position in the room.
[[nodiscard]] const std::vector<std::uint32_t>& images_at(const LightingContext& lighting, const geometry::Position& at);

}  // namespace orbc::light
