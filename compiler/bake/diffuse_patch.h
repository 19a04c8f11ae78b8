#pragma once
#include "compiler/bake/bake_part.h"
#include "compiler/bake/irradiance_grid.h"
#include "compiler/bake/patch_texels.h"

namespace orbc::bake {

/// Samples the irradiance that lamps give a patch: densely where it changes, coarsely elsewhere.
/// In:    the light at the vertices of the part.
/// Makes: a grid as coarse as shows all samples; black for emissive surfaces.
[[nodiscard]] IrradianceGrid bake_direct(const BakePart& part, const VertexLight& vertices, const TexelPatch& patch);

/// The colours of a patch: irradiance times albedo, times the exposure.
/// In:    `indirect` is what other surfaces give, divided by π; null where there is none.
/// Makes: as many texels as the grids have points, and as the pattern of the surface needs (pattern_density).
[[nodiscard]] PatchTexels shade_patch(const BakePart& part, const TexelPatch& patch, const IrradianceGrid& direct,
                                      const IrradianceGrid* indirect);

}  // namespace orbc::bake
