#pragma once
#include <cstdint>
#include <functional>

#include "compiler/base/result.h"
#include "compiler/mesh/mesh.h"

namespace orbc::mesh {

/// Whether the edge between two positions has to be split. Must say the same for (a, b) and (b, a).
using SplitEdge = std::function<bool(const geometry::Vector3& a, const geometry::Vector3& b)>;

/// Splits edges in the middle until `split` says no of every edge.
/// Makes:        positions, uv and colours of new vertices are the mean of the edge's ends; triangles keep their material and
///               orientation. The decision is made from the edge's two positions alone, so no crack opens, also where vertices are doubled
///               at a uv seam. Same input, same bytes.
/// Diagnostics:  mesh.too-dense when more than `max_triangles` would be needed.
[[nodiscard]] Result<Mesh> refine(const Mesh& mesh, const SplitEdge& split, std::uint64_t max_triangles = 20'000'000);

}  // namespace orbc::mesh
