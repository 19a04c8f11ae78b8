#pragma once
#include <cstddef>

#include "compiler/base/result.h"
#include "compiler/place/interior.h"

namespace orbc::place {

/// Cuts a mesh where its uv pass whole numbers and moves the uv of every triangle into [0, 1]², so that its texture can be put into an
/// atlas. In:          uv per vertex, linear in the triangles. Meshes without uv come back unchanged. Makes:       triangles that share an
/// edge with equal uv are cut at the same vertices. Vertices on a cut are duplicated, once per repeat. Diagnostics: place.too-many-repeats
/// when more than `max_triangles` would be needed.
[[nodiscard]] Result<PlacedMesh> cut_at_uv_repeats(geometry::Space space, PlacedMesh mesh, std::size_t max_triangles = 1'000'000);

/// Cuts a mesh into the cells of a solid checker, along the planes at multiples of `cell` in its pattern_position.
/// Makes:       style 0 or 1 by the parity of the cell's numbers; it replaces the styles that the mesh had.
/// Diagnostics: place.too-many-cells when more than `max_triangles` would be needed.
[[nodiscard]] Result<PlacedMesh> checkered(geometry::Space space, PlacedMesh mesh, double cell, std::size_t max_triangles = 1'000'000);

}  // namespace orbc::place
