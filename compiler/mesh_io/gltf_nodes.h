#pragma once
#include <optional>
#include <vector>

#include "compiler/geometry/point.h"
#include "compiler/mesh_io/gltf_accessor.h"

namespace orbc::mesh_io {

/// An affine map: columns of the linear part, and the translation.
struct AffineMap {
  geometry::Vector3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, t{0, 0, 0};
  geometry::Vector3 linear(const geometry::Vector3& p) const { return p.x * x + p.y * y + p.z * z; }
  geometry::Vector3 operator()(const geometry::Vector3& p) const { return linear(p) + t; }
  AffineMap operator*(const AffineMap& b) const { return {linear(b.x), linear(b.y), linear(b.z), (*this)(b.t)}; }
  double determinant() const { return dot(x, cross(y, z)); }
};

/// A mesh of the model where a node of the scene puts it.
struct MeshInstance {
  int mesh = 0;
  AffineMap scene_from_mesh;
  std::vector<double> morph_weights;       ///< of the mesh's morph targets, in the default pose
  std::vector<AffineMap> scene_from_bind;  ///< of a skinned mesh: per joint, from where the mesh is bound; then scene_from_mesh is unused
};

/// The meshes of the default scene (else the first; else of every root node), in the order of a walk that visits parents before children:
/// each in its default pose, each copy of EXT_mesh_gpu_instancing, nothing that KHR_node_visibility hides.
/// Throws: GltfError where the nodes are no tree.
[[nodiscard]] std::vector<MeshInstance> mesh_instances(const GltfSource& source);

}  // namespace orbc::mesh_io
