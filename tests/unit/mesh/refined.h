#pragma once
#include "compiler/mesh/refine.h"

namespace orbc::mesh::test {

/// Refines until no edge is longer than `max_edge`.
inline Result<Mesh> refine_to_length(const Mesh& mesh, double max_edge, std::uint64_t max_triangles = 20'000'000) {
  const double square = max_edge * max_edge;
  const auto is_long = [square](const geometry::Vector3& a, const geometry::Vector3& b) { return dot(a - b, a - b) > square; };
  return refine(mesh, is_long, max_triangles);
}

}  // namespace orbc::mesh::test
