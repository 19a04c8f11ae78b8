#pragma once
#include "compiler/bake/bake.h"
#include "compiler/bake/blocks.h"

namespace orbc::bake {

/// Halvings of a side of a block that make so many cells, at most 11 (2049 points); a half of one is rounded off, since meshes finer than
/// asked for gain nothing.
[[nodiscard]] int level_of(double cells);

/// Texels per unit of length for what varies on a block's surface: of solid patterns as many as they ask for, since granite hides detail
/// that marble of the same cell does not have.
/// Error: but for a few places, texels looked up in between are within twice the tolerance of the pattern itself, up to 3 times
///        `texture_fine` texels.
[[nodiscard]] double pattern_density(const place::PlacedRoom& room, const place::PlacedMesh& mesh, const Block& block,
                                     const BakeOptions& options);

}  // namespace orbc::bake
