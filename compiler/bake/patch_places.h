#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "compiler/bake/patches.h"
#include "compiler/bake/rect_packing.h"

namespace orbc::bake {

/// The first vertex of each patch in a part of split_by_patch, whose vertices stand patch by patch.
[[nodiscard]] std::vector<std::size_t> first_vertices(const std::vector<TexelPatch>& patches);

/// Puts the vertices of a patch on the corners of a rectangle of a packed picture.
void place_patch(std::vector<std::array<float, 2>>& uv, const TexelPatch& patch, std::size_t first_vertex, const TexelRect& rect,
                 const PackedRects& packed);

/// Places in a picture that has become larger to the right and below. In: the old size over the new one.
[[nodiscard]] std::vector<std::array<float, 2>> rescale_uv(std::vector<std::array<float, 2>> uv, double u, double v);

}  // namespace orbc::bake
