#pragma once
#include <cstdint>
#include <vector>

#include "compiler/mesh/mesh.h"

namespace orbc::mesh {

/// For each vertex the first of those with bitwise its position (−0 and 0 are one): files double vertices at uv seams.
[[nodiscard]] std::vector<std::uint32_t> welded(const std::vector<geometry::Vector3>& positions);

/// Drops vertices that no triangle uses; the others keep their order. Makes: which vertex each one left was.
std::vector<std::uint32_t> leave_out_unused(Mesh& mesh);

}  // namespace orbc::mesh
