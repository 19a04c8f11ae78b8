#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "compiler/base/result.h"
#include "compiler/mesh/mesh.h"
#include "compiler/mesh_io/load.h"
#include "compiler/mesh_io/wrap_modes.h"

namespace orbc::mesh_io {

/// The file that is being read, and what may be asked of the machine.
struct ReadContext {
  const std::string& name;    ///< what diagnostics call it
  const std::string& folder;  ///< where the files are that it refers to; "" refuses every reference
  const LoadOptions& options;
};

/// Polygons as a file lists them. There is no topology, so a mesh that is not a manifold loses nothing.
struct PolygonSoup {
  std::vector<geometry::Vector3> positions;
  std::vector<std::uint32_t> corners;           ///< vertex of each corner, face after face
  std::vector<std::uint32_t> face_begin{0};     ///< first corner of each face; one more at the end
  std::vector<std::array<float, 2>> corner_uv;  ///< of each corner (v from top), or empty
  std::vector<mesh::LinearColor> vertex_color;  ///< of each vertex, or empty
  std::vector<mesh::LinearColor> face_color;    ///< of each face, or empty
  std::vector<std::uint32_t> face_material;     ///< of each face, index into `materials`; or empty
  std::vector<mesh::Material> materials;
  std::vector<WrapModes> wrap_modes;  ///< of materials; of those behind its end: repeated
  std::vector<image::Image> textures;
  Diagnostics warnings;

  [[nodiscard]] std::size_t faces() const { return face_begin.size() - 1; }
  /// Ends the face whose corners have been appended to `corners`.
  void end_face() { face_begin.push_back(static_cast<std::uint32_t>(corners.size())); }
};

/// Triangulates, splits vertices where corners differ in uv or colour, leaves out unused vertices and faces without three vertices.
/// In:           corners < positions.size(), all numbers finite.
/// Diagnostics:  mesh.no-triangles, mesh.too-big; warning mesh.too-many-looks; note mesh.skipped-faces.
[[nodiscard]] Result<mesh::LoadedMesh> to_mesh(PolygonSoup soup, const ReadContext& context);

}  // namespace orbc::mesh_io
