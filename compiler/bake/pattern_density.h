#pragma once
#include "compiler/bake/bake_options.h"
#include "compiler/bake/patches.h"

namespace orbc::bake {

/// How often a side of a patch is halved to have about this many cells: log₂, rounded to the nearest, 0 to 11 (2049 points).
[[nodiscard]] int halvings(double cells);

/// Texels per unit of length that the texture or the solid pattern of a patch needs. Solid patterns get as many as interpolation asks for:
/// marble has none of the fine detail that granite of the same cell has.
/// Error: at all but one in 25 points, colours interpolated between texels are within twice the tolerance of the pattern, unless that
///        takes more than 3 times `texture_density` texels.
[[nodiscard]] double pattern_density(const place::Interior& interior, const place::PlacedMesh& mesh, const TexelPatch& patch,
                                     const BakeOptions& options);

}  // namespace orbc::bake
