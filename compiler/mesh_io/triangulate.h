#pragma once
#include <cstdint>
#include <vector>

#include "compiler/mesh/mesh.h"

namespace orbc::mesh_io {

/// Cuts one polygon into triangles.
/// In:     at least three corners in order; neighbours differ. A corner may occur twice, as in a polygon with a hole that a bridge joins to
///         its border.
/// Makes:  indices into `polygon`, oriented as it is. A small simple polygon is cut into well-shaped triangles by choosing the best ear
///         again and again; a long one, and one that touches itself, by taking ears as they come. One that crosses itself gets some
///         triangles.
/// Changes `ear_tests`: what is left of the work that may be spent; at 0 all polygons become fans.
[[nodiscard]] std::vector<mesh::Triangle> triangulate(const std::vector<geometry::Vector3>& polygon, std::int64_t& ear_tests);

}  // namespace orbc::mesh_io
