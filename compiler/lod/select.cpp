#include "compiler/lod/select.h"

#include <algorithm>
#include <map>

namespace orbc::lod {
namespace {

using place::PlacedMesh;

// From this tolerance on, larger than any picture, levels are selected even where their displacement in pixels has no bound: around the
// eye.
constexpr double kUnboundedTolerancePx = 1e5;

/// Collects the levels of copies; equal ones get the same number.
class SelectionBuilder {
 public:
  std::uint32_t index_of(const std::vector<std::uint16_t>& levels) {
    const auto [at, is_new] = known_.try_emplace(levels, static_cast<std::uint32_t>(selection.levels_of_model.size()));
    if (is_new) selection.levels_of_model.push_back(levels);
    return at->second;
  }
  void add_copy(const std::vector<std::uint16_t>& levels) { selection.model_of_copy.push_back(index_of(levels)); }
  LodSelection selection;

 private:
  std::map<std::vector<std::uint16_t>, std::uint32_t> known_;
};

}  // namespace

LodSelection full_detail(const InteriorWithLods& lods, std::size_t copies) {
  return {{std::vector<std::uint16_t>(room_part_count(lods), 0)}, std::vector<std::uint32_t>(copies, 0), 0};
}

LodSelection select_lods(const InteriorWithLods& lods, const std::vector<cover::Copy>& copies, const place::Camera& eye,
                         const bend::BendOptions& options) {
  const bend::ScreenSize detail(eye, options);
  const std::size_t part_count = room_part_count(lods);
  std::vector<bend::BoundingCylinder> extents;
  for (std::size_t p = 0; p < part_count; ++p)
    extents.push_back(bend::bounding_cylinder(lods.interior.polygon.space, lods.interior.parts[p]));
  SelectionBuilder builder;
  std::vector<std::uint16_t> levels(part_count, 0);
  for (const cover::Copy& copy : copies) {
    for (std::size_t p = 0; p < part_count; ++p) {
      levels[p] = 0;
      const std::vector<std::uint32_t>& chain = lods.part_of_level[p];
      if (chain.size() == 1) continue;
      // The displaced surface stays within the offset of the part. A tenth of its radius holds most offsets, and gives a better bound.
      double margin = extents[p].radius / 10, pixels = detail.pixels_per_length(copy, extents[p], margin);
      for (std::size_t level = 1; level < chain.size(); ++level) {
        const double offset = lods.surface_offset[chain[level]];
        if (offset > margin) {
          margin = offset;
          pixels = detail.pixels_per_length(copy, extents[p], margin);
        }
        if (!(pixels * offset <= options.tolerance_px) && options.tolerance_px < kUnboundedTolerancePx) break;
        levels[p] = static_cast<std::uint16_t>(level);
        builder.selection.error_px = std::max(builder.selection.error_px, std::min(pixels * offset, options.tolerance_px));
      }
    }
    builder.add_copy(levels);
  }
  if (builder.selection.levels_of_model.empty()) (void)builder.index_of(std::vector<std::uint16_t>(part_count, 0));
  return std::move(builder.selection);
}

LodStats lod_stats(const InteriorWithLods& lods, const LodSelection& selection) {
  LodStats stats;
  const std::vector<PlacedMesh>& parts = lods.interior.parts;
  std::uint64_t full = 0;
  for (std::size_t p = 0; p < room_part_count(lods); ++p) full += parts[p].triangles.size();
  for (const std::uint32_t model : selection.model_of_copy) {
    int coarsest = 0;
    for (std::size_t p = 0; p < room_part_count(lods); ++p) {
      const std::uint16_t level = selection.levels_of_model[model][p];
      coarsest = std::max<int>(coarsest, level);
      stats.triangles_saved += parts[p].triangles.size() - parts[lods.part_of_level[p][level]].triangles.size();
    }
    stats.level_of_copy.push_back(coarsest);
  }
  stats.triangles = full * selection.model_of_copy.size() - stats.triangles_saved;
  return stats;
}

place::Interior coarse_proxy(const InteriorWithLods& lods, double max_offset) {
  const place::Interior& room = lods.interior;
  place::Interior proxy;
  proxy.polygon = room.polygon;
  proxy.height = room.height;
  proxy.mirrors = room.mirrors;
  proxy.styles = room.styles;
  for (place::SurfaceStyle& look : proxy.styles) look.texture = -1;
  for (const std::vector<std::uint32_t>& chain : lods.part_of_level) {
    std::uint32_t coarsest = chain[0];
    for (const std::uint32_t part : chain)
      if (lods.surface_offset[part] <= max_offset) coarsest = part;
    proxy.parts.push_back(room.parts[coarsest]);
  }
  return proxy;
}

}  // namespace orbc::lod
