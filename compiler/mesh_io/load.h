#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "compiler/base/result.h"
#include "compiler/image_io/limits.h"
#include "compiler/mesh/asset_source.h"

namespace orbc::mesh_io {

/// Bounds on what a mesh file may ask of the machine. The defaults are those of 4 GiB.
struct LoadOptions {
  std::uint64_t max_file_bytes = std::uint64_t{1} << 30;  ///< of the file and of each kind of thing it refers to, together
  std::uint64_t max_triangles = 10'000'000;               ///< after triangulation and instancing; vertices: three times as many
  image_io::ImageLimits images;
  /// Called with the path of every file before it is read: of meshes, and of the files that they refer to. May be empty.
  std::function<void(const std::string& path)> on_read;
};

/// Calls `options.on_read` unless it is empty.
inline void report_read(const LoadOptions& options, const std::string& path) {
  if (options.on_read) options.on_read(path);
}

/// The bounds that suit a program that may take so many bytes: a quarter of them for a file, an eighth for the pictures of a mesh, and 400
/// for each triangle, which is what it takes from the file to the tracer and the bake.
[[nodiscard]] LoadOptions bounds_within(std::uint64_t max_memory);

/// Reads a mesh file: OBJ with its MTL, PLY, OFF, STL, GLB or glTF. The ending of the path says which.
/// Makes:        one triangle mesh in the file's own axes (glTF: y up), positions in double precision. Polygons are triangulated. A vertex
///               is split where its corners differ in uv or colour. Vertices that no triangle uses are left out.
/// Diagnostics:  mesh.missing-file, mesh.not-a-file, mesh.unknown-format, mesh.too-big, mesh.truncated, mesh.bad-header, mesh.bad-number,
///               mesh.not-finite, mesh.bad-index, mesh.no-triangles, mesh.bad-gltf, mesh.unsupported, mesh.bad-reference, mesh.bad-texture;
///               warnings: mesh.bad-texture, mesh.too-many-looks, mesh.ignored; note: mesh.skipped-faces.
[[nodiscard]] Result<mesh::LoadedMesh> load_mesh(const std::string& path, const LoadOptions& options = {});

enum class Format { obj, ply, off, stl, gltf, glb };

/// The format of a file by the ending of its name; nothing for endings that are not known.
[[nodiscard]] std::optional<Format> format_of(const std::string& path);

/// Reads a mesh from memory, as load_mesh does.
/// In: `name` is what diagnostics call the file; `folder` is where the files are that it refers to, "" refuses every reference.
[[nodiscard]] Result<mesh::LoadedMesh> load_mesh_bytes(std::string_view bytes, Format format, const std::string& name,
                                                       const std::string& folder, const LoadOptions& options = {});

/// The disk as a source of meshes and pictures: load_mesh and image_io::load_image with these bounds.
[[nodiscard]] mesh::AssetSource assets_from_files(const LoadOptions& options = {});

}  // namespace orbc::mesh_io
