#pragma once
#include <cstdint>
#include <vector>

#include "compiler/mesh/mesh.h"

namespace orbc::mesh {

/// Makes: for each vertex the first of those with bitwise its position (−0 and 0 are one). Files double vertices at uv seams.
[[nodiscard]] std::vector<std::uint32_t> weld_positions(const std::vector<geometry::Vector3>& positions);

/// A mesh without unused vertices.
struct CompactMesh {
  Mesh mesh;
  std::vector<std::uint32_t> origin;  ///< per vertex: which one of the given mesh it was
};

/// Removes vertices that no triangle uses. The others keep their order.
[[nodiscard]] CompactMesh remove_unused_vertices(Mesh mesh);

}  // namespace orbc::mesh
