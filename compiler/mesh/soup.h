#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "compiler/base/diagnostic.h"
#include "compiler/mesh/load.h"

namespace orbc::mesh {

/// Polygons as a file lists them: no topology, so that nothing is lost of a non-manifold mesh.
struct Soup {
  std::vector<geometry::Vector3> positions;
  std::vector<std::uint32_t> corners;     ///< vertex of each corner, face after face
  std::vector<std::array<float, 2>> uv;   ///< of each corner (v from top), or empty
  std::vector<std::uint32_t> face_begin;  ///< first corner of each face; one more at the end
  std::vector<std::uint8_t> look;         ///< of each face, or empty
};

/// Triangulates, splits vertices at uv seams, leaves out unused vertices and faces that use a vertex twice.
/// In:           corners < positions.size(), all numbers finite.
/// Diagnostics:  mesh.no-triangles, mesh.too-big; warning mesh.skipped-faces.
[[nodiscard]] Result<Loaded> to_mesh(const Soup& soup, const std::string& name, const LoadOptions& options);

/// Cuts a polygon into triangles (indices into `polygon`): ears are cut in the plane of its area vector, the best-shaped first;
/// a polygon that has none (it crosses itself) becomes a fan. `budget` bounds the work over many polygons: below 0 all become fans.
[[nodiscard]] std::vector<Triangle> triangulate(const std::vector<geometry::Vector3>& polygon, std::int64_t& budget);

}  // namespace orbc::mesh
