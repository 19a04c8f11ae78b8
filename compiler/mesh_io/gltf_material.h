#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

#include "compiler/mesh_io/gltf_accessor.h"
#include "compiler/mesh_io/wrap_modes.h"

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

/// The one texture that is shown of a material.
struct GltfTextureUse {
  int index = -1;  ///< −1: there is none
  int uv_set = 0;
  const tinygltf::Value* transform = nullptr;  ///< KHR_texture_transform, or null
};

/// Makes materials and textures of those that are used, each once, in the order of their first use.
class GltfMaterials {
 public:
  GltfMaterials(const GltfSource& source, const GltfPictures& pictures) : source_(source), pictures_(pictures) {}

  /// In: the number of a material, −1 for the default. Makes: its index into `materials`. Throws: GltfError.
  std::uint16_t index_of(int material);
  /// In: as above. The transformation is trivial for a material without a texture.
  [[nodiscard]] UvTransform uv_transform(int material) const;
  /// What its author should know of the materials converted so far.
  [[nodiscard]] Diagnostics warnings() const;

  std::vector<mesh::Material> materials;
  std::vector<WrapModes> wrap_modes;  ///< of each material
  std::vector<image::Image> textures;

 private:
  mesh::Material convert(const tinygltf::Material& material);
  void set_base_color(const tinygltf::Material& material, mesh::Material& made);
  void set_kind(const tinygltf::Material& material, mesh::Material& made);
  void set_metal_or_glossy(const tinygltf::Material& material, mesh::Material& made);
  void set_alpha(const tinygltf::Material& material, mesh::Material& made);
  [[nodiscard]] WrapModes wrap_modes_of(int texture) const;
  int load_texture(int texture);
  [[nodiscard]] Result<image::Image> load_image_of(int texture) const;
  [[nodiscard]] Result<image::Image> load_image(int index) const;

  const GltfSource& source_;
  const GltfPictures& pictures_;
  std::map<int, std::uint16_t> index_of_material_;
  std::map<int, int> index_of_texture_;
  Diagnostics texture_warnings_;
  std::set<std::string> left_out_;  ///< what materials have and is not shown
  bool is_blended_ = false, are_too_many_ = false;
};

}  // namespace orbc::mesh_io
