#pragma once
#include "compiler/mesh_io/gltf_material.h"
#include "compiler/mesh_io/gltf_nodes.h"

namespace orbc::mesh_io {

/// All triangles of the instances in the axes of the scene, with their uv and materials. Throws: GltfError.
[[nodiscard]] mesh::Mesh assemble_mesh(const GltfSource& source, const std::vector<MeshInstance>& instances, GltfMaterials& materials);

}  // namespace orbc::mesh_io
