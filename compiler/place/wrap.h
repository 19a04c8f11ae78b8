#pragma once
#include <cstddef>

#include "compiler/base/result.h"
#include "compiler/place/placed.h"

namespace orbc::place {

/// Cuts a mesh where its uv pass whole numbers and moves every triangle's uv into the one repeat [0, 1]², so that a texture may lie in an
/// atlas.
/// In:          uv per vertex, affine in the triangles. Meshes without uv come back as they are.
/// Makes:       triangles that share an edge and its uv are cut at the same vertices; vertices on a cut are doubled, once for each repeat.
/// Diagnostics: place.too-many-repeats when more than `max_triangles` would be needed.
[[nodiscard]] Result<PlacedMesh> wrapped(geometry::Space space, PlacedMesh mesh, std::size_t max_triangles = 1'000'000);

/// Cuts a mesh into the cells of a solid checker: along the planes at multiples of `cell` in its pattern_position.
/// Makes:       look 0 or 1 by the parity of the cell's numbers, in place of the looks the mesh had.
/// Diagnostics: place.too-many-cells.
[[nodiscard]] Result<PlacedMesh> checkered(geometry::Space space, PlacedMesh mesh, double cell, std::size_t max_triangles = 1'000'000);

}  // namespace orbc::place
