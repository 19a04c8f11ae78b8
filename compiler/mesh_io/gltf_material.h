#pragma once
#include <map>
#include <string>
#include <vector>

#include "compiler/mesh_io/gltf_accessor.h"

namespace orbc::mesh_io {

/// Pictures of a glTF file that are not in its buffers, by the number of the image: still encoded, or why they cannot be had.
struct GltfPictures {
  std::map<int, std::string> encoded;
  Diagnostics refused;
};

/// How a material looks its texture up: which uv, and KHR_texture_transform.
struct UvTransform {
  int set = 0;
  double offset[2] = {0, 0}, scale[2] = {1, 1}, rotation = 0;
};

/// Makes materials and textures of those that are used, each once, in the order of their first use.
class GltfMaterials {
 public:
  GltfMaterials(const GltfSource& source, const GltfPictures& pictures) : source_(source), pictures_(pictures) {}

  /// In: the number of a material, −1 for the default. Makes: its index into `materials`. Throws: GltfError.
  std::uint16_t index_of(int material);
  /// In: as above. The transformation is trivial for a material without a texture.
  [[nodiscard]] UvTransform uv_transform(int material) const;

  std::vector<mesh::Material> materials;
  std::vector<image::Image> textures;
  Diagnostics warnings;

 private:
  const tinygltf::TextureInfo* texture_info(int material) const;
  mesh::Material convert(const tinygltf::Material& material);
  int load_texture(int texture);
  Result<image::Image> load_image(int index) const;

  const GltfSource& source_;
  const GltfPictures& pictures_;
  std::map<int, std::uint16_t> index_of_material_;
  std::map<int, int> index_of_image_;
  bool has_warned_of_number_ = false;
};

}  // namespace orbc::mesh_io
