#pragma once
#include <string_view>

#include "compiler/mesh_io/polygon_soup.h"

namespace orbc::mesh_io {

/// Reads glTF 2.0 through tinygltf: the default scene (else the first; else every root node), all triangle primitives.
[[nodiscard]] Result<mesh::LoadedMesh> read_gltf(std::string_view bytes, bool binary, const ReadContext& context);

/// Looks over the JSON and the chunks before tinygltf sees them: depth, number of objects and values, buffers times their size, chunk
/// lengths. tinygltf descends recursively and makes large structs of tiny objects.
/// Diagnostics: mesh.bad-gltf, mesh.truncated, mesh.too-big.
[[nodiscard]] Diagnostics scan_gltf(std::string_view bytes, bool binary, const ReadContext& context);

}  // namespace orbc::mesh_io
