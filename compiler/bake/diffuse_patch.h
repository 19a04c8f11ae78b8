#pragma once
#include <functional>

#include "compiler/bake/adaptive_grid.h"
#include "compiler/bake/bake_part.h"
#include "compiler/bake/irradiance_grid.h"
#include "compiler/bake/patch_texels.h"

namespace orbc::bake {

/// How points see images of lamps.
struct SeenImages {
  std::vector<std::uint32_t> images;  ///< of the lighting, ascending
  std::vector<light::ImageVisibility> visibility;
};
/// The light at a corner of a patch, which patches that meet there share.
struct CornerSample {
  GridSample light;
  const SeenImages* seen = nullptr;  ///< null: not known
};
using CornerLight = std::function<CornerSample(const PatchCorner&)>;
/// The same from the light at all vertices of the part, which it refers to.
[[nodiscard]] CornerLight corner_light(const BakePart& part, const VertexLight& vertices);

/// The irradiance of a patch, and where interpolation may miss it.
struct DirectLight {
  IrradianceGrid irradiance;  ///< as coarse as shows all samples; black for emissive surfaces
  /// 0: light is interpolated in the cell; else 1 + the index of its entry in `expected`, because borders of shadows in it are finer. Row
  /// by row, (width − 1) × (height − 1); empty: no cell is rough
  std::vector<std::uint32_t> rough_cell;
  std::vector<std::uint32_t> images;                          ///< that may light the patch; empty unless a cell is rough
  std::vector<std::vector<light::ImageVisibility>> expected;  ///< of these images, what the corners of rough cells agree on; or empty
};
/// Samples the irradiance that lamps give a patch: densely where it changes, coarsely elsewhere.
/// Error: away from rough cells BakeOptions::tolerance, but for what lies between the points of BakeOptions::min_density.
[[nodiscard]] DirectLight bake_direct(const BakePart& part, const CornerLight& corners, const TexelPatch& patch);

/// The colours of a patch: irradiance times albedo, times the exposure.
/// In:    `indirect` is what other surfaces give, divided by π; null where there is none.
/// Makes: as many texels as the grids have points, and as the pattern of the surface needs (pattern_density).
[[nodiscard]] PatchTexels shade_patch(const BakePart& part, const TexelPatch& patch, const IrradianceGrid& direct,
                                      const IrradianceGrid* indirect);

}  // namespace orbc::bake
