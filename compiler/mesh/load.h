#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "compiler/base/result.h"
#include "compiler/image_io/limits.h"
#include "compiler/mesh/mesh.h"

namespace orbc::mesh {

/// Bounds on what a mesh file may ask of the machine.
struct LoadOptions {
  std::uint64_t max_file_bytes = std::uint64_t{1} << 30;  ///< of the file and of each kind of thing it refers to, together
  std::uint64_t max_triangles = 20'000'000;               ///< after triangulation and instancing; vertices: three times as many
  image_io::ImageLimits images;
};

/// A mesh and what its author should know about it.
struct Loaded {
  Mesh mesh;
  Diagnostics warnings;
};

/// Reads a mesh file: OBJ (with its MTL), PLY, OFF, STL through OpenMesh, GLB and glTF through tinygltf.
/// Makes:        one triangle mesh in the file's own axes (glTF: y up); polygons triangulated; vertices split where a corner has several
/// uv;
///               node transforms of glTF applied; vertices that no triangle uses are left out.
/// Diagnostics:  mesh.missing-file, mesh.not-a-file, mesh.unknown-format, mesh.too-big, mesh.truncated, mesh.bad-header, mesh.bad-number,
///               mesh.not-finite, mesh.bad-index, mesh.no-triangles, mesh.bad-gltf, mesh.unsupported, mesh.bad-reference, mesh.bad-texture;
///               warnings: mesh.bad-texture, mesh.too-many-looks, mesh.ignored; note: mesh.skipped-faces.
/// Not promised: vertex colours, normals, animation, skins, morph targets: they are read over.
[[nodiscard]] Result<Loaded> load_mesh(const std::string& path, const LoadOptions& options = {});

enum class Format { obj, ply, off, stl, gltf, glb };

/// The same for bytes in memory. `name` is what diagnostics call the file; `folder` is where the files it refers to are, "" = refer to
/// none.
[[nodiscard]] Result<Loaded> load_mesh_bytes(std::string_view bytes, Format format, const std::string& name, const std::string& folder,
                                             const LoadOptions& options = {});

}  // namespace orbc::mesh
