// Materials of glTF (specification 2.0.1, section 3.9): base colour and its texture.
#include "compiler/mesh_io/gltf_material.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "compiler/image_io/decode.h"
#include "compiler/mesh_io/errors.h"

namespace orbc::mesh_io {
namespace {

double number_or(const tinygltf::Value& value, double otherwise) { return value.IsNumber() ? value.GetNumberAsDouble() : otherwise; }

}  // namespace

const tinygltf::TextureInfo* GltfMaterials::texture_info(int material) const {
  const auto& all = source_.model.materials;
  if (material < 0 || static_cast<std::size_t>(material) >= all.size()) return nullptr;
  const auto& info = all[static_cast<std::size_t>(material)].pbrMetallicRoughness.baseColorTexture;
  return info.index >= 0 ? &info : nullptr;
}

UvTransform GltfMaterials::uv_transform(int material) const {
  UvTransform made;
  const auto* info = texture_info(material);
  if (!info) return made;
  made.set = info->texCoord;
  const auto found = info->extensions.find("KHR_texture_transform");
  if (found == info->extensions.end() || !found->second.IsObject()) return made;
  const auto& transform = found->second;
  for (int k = 0; k < 2; ++k) {
    if (transform.Get("offset").IsArray()) made.offset[k] = number_or(transform.Get("offset").Get(k), 0);
    if (transform.Get("scale").IsArray()) made.scale[k] = number_or(transform.Get("scale").Get(k), 1);
  }
  made.rotation = number_or(transform.Get("rotation"), 0);
  made.set = static_cast<int>(number_or(transform.Get("texCoord"), made.set));
  return made;
}

std::uint16_t GltfMaterials::index_of(int material) {
  const auto known = index_of_material_.find(material);
  if (known != index_of_material_.end()) return known->second;
  mesh::Material converted;
  if (material >= 0) converted = convert(entry(source_, source_.model.materials, material, fmt::format("material {}", material)));
  if (materials.size() < kMaxMaterials) {
    materials.push_back(converted);
  } else if (!has_warned_of_number_) {
    has_warned_of_number_ = true;
    warnings.push_back(make_warning("mesh.too-many-looks", fmt::format("{}: more than {} materials; the others look like the last one",
                                                                       source_.context.name, kMaxMaterials)));
  }
  return index_of_material_[material] = static_cast<std::uint16_t>(materials.size() - 1);
}

mesh::Material GltfMaterials::convert(const tinygltf::Material& material) {
  mesh::Material made;
  const auto& pbr = material.pbrMetallicRoughness;
  made.color = {1, 1, 1};
  for (std::size_t k = 0; k < 3 && k < pbr.baseColorFactor.size(); ++k) {
    const double value = pbr.baseColorFactor[k];
    made.color[k] = value >= 0 && value <= 1 ? value : 1;
  }
  if (pbr.baseColorTexture.index >= 0) made.texture = load_texture(pbr.baseColorTexture.index);
  // Alpha is that of the texture times that of the factor.
  const double factor = pbr.baseColorFactor.size() == 4 ? pbr.baseColorFactor[3] : 1;
  if (material.alphaMode == "MASK" && made.texture >= 0) made.alpha_cutoff = factor > 0 ? std::max(0.0, material.alphaCutoff / factor) : 2;
  return made;
}

int GltfMaterials::load_texture(int texture) {
  const int image = entry(source_, source_.model.textures, texture, fmt::format("texture {}", texture)).source;
  const auto known = index_of_image_.find(image);
  if (known != index_of_image_.end()) return known->second;
  auto picture = load_image(image);
  if (!picture) {
    const auto& reason = picture.error().front();
    warnings.push_back(
        make_warning("mesh.bad-texture", fmt::format("{}: a texture is left out: {}", source_.context.name, reason.message), reason.hint));
    return index_of_image_[image] = -1;
  }
  textures.push_back(*std::move(picture));
  return index_of_image_[image] = static_cast<int>(textures.size()) - 1;
}

Result<image::Image> GltfMaterials::load_image(int index) const {
  const auto& images = source_.model.images;
  if (index < 0 || static_cast<std::size_t>(index) >= images.size())
    return make_error("mesh.bad-texture", fmt::format("image {} is not there, or of a kind that is not read", index));
  auto limits = source_.context.options.images;
  for (const auto& texture : textures) limits.max_bytes -= std::min<std::uint64_t>(limits.max_bytes, texture.rgba.size());
  const auto& image = images[static_cast<std::size_t>(index)];
  const auto what = fmt::format("image {}", index);
  if (image.bufferView >= 0) {
    const auto size = entry(source_, source_.model.bufferViews, image.bufferView, what + ": its buffer view").byteLength;
    const auto* bytes = bytes_of_view(source_, image.bufferView, 0, size, what);
    return image_io::decode_image({reinterpret_cast<const char*>(bytes), size}, what, limits);
  }
  const auto found = pictures_.encoded.find(index);
  if (found != pictures_.encoded.end()) return image_io::decode_image(found->second, what, limits);
  if (!pictures_.refused.empty()) return pictures_.refused.front();
  return make_error("mesh.bad-texture", what + " is empty");
}

}  // namespace orbc::mesh_io
