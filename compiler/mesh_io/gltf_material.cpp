// Materials of glTF (specification 2.0.1, section 3.9, and the KHR_materials extensions): what comes nearest among ours. A material is
// emissive where it is brighter than it is coloured, glass where it transmits more than half, metal from a metallic of one half on, else
// glossy below a roughness of one half where that is said, else matte.
#include "compiler/mesh_io/gltf_material.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

#include "compiler/image_io/decode.h"
#include "compiler/mesh_io/errors.h"
#include "compiler/mesh_io/transparency.h"

namespace orbc::mesh_io {
namespace {

using tinygltf::Value;

const Value* extension(const tinygltf::ExtensionMap& extensions, const char* name) {
  const auto found = extensions.find(name);
  return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

double number_or(const Value& value, double otherwise) { return value.IsNumber() ? value.GetNumberAsDouble() : otherwise; }

double number_in(const Value* object, const char* key, double otherwise) {
  return object && object->Has(key) ? number_or(object->Get(key), otherwise) : otherwise;
}

const Value* object_in(const Value* object, const char* key) {
  return object && object->Has(key) && object->Get(key).IsObject() ? &object->Get(key) : nullptr;
}

double share(double value) { return value >= 0 && value <= 1 ? value : 1; }

std::array<double, 4> color_in(const Value* object, const char* key) {
  std::array<double, 4> color{1, 1, 1, 1};
  if (!object || !object->Has(key) || !object->Get(key).IsArray()) return color;
  for (std::size_t k = 0; k < 4 && k < object->Get(key).ArrayLen(); ++k)
    color[k] = share(number_or(object->Get(key).Get(static_cast<int>(k)), 1));
  return color;
}

const Value* specular_glossiness(const tinygltf::Material& material) {
  return extension(material.extensions, "KHR_materials_pbrSpecularGlossiness");
}

std::array<double, 4> base_color(const tinygltf::Material& material) {
  if (const Value* old = specular_glossiness(material)) return color_in(old, "diffuseFactor");
  std::array<double, 4> color{1, 1, 1, 1};
  const auto& factor = material.pbrMetallicRoughness.baseColorFactor;
  for (std::size_t k = 0; k < 4 && k < factor.size(); ++k) color[k] = share(factor[k]);
  return color;
}

std::array<double, 3> emitted(const tinygltf::Material& material) {
  const double strength = number_in(extension(material.extensions, "KHR_materials_emissive_strength"), "emissiveStrength", 1);
  std::array<double, 3> color{0, 0, 0};
  for (std::size_t k = 0; k < 3 && k < material.emissiveFactor.size(); ++k)
    color[k] = std::clamp(strength * material.emissiveFactor[k], 0.0, 1e6);
  return color;
}

double brightest(const std::array<double, 3>& color) { return *std::max_element(color.begin(), color.end()); }

/// Whether the light of a material is shown in place of its colour.
bool shows_emission(const tinygltf::Material& material) {
  const auto base = base_color(material);
  const double light = brightest(emitted(material));
  const bool is_black = std::max({base[0], base[1], base[2]}) == 0;
  if (material.emissiveTexture.index >= 0) return light > 0 && is_black;
  return light > 0 && (is_black || light >= std::max({base[0], base[1], base[2]}));
}

GltfTextureUse use_of(const tinygltf::TextureInfo& info) {
  return {info.index, info.texCoord, extension(info.extensions, "KHR_texture_transform")};
}

GltfTextureUse texture_use(const tinygltf::Material& material) {
  if (shows_emission(material)) return use_of(material.emissiveTexture);
  const Value* old = specular_glossiness(material);
  if (!old) return use_of(material.pbrMetallicRoughness.baseColorTexture);
  const Value* texture = object_in(old, "diffuseTexture");
  return {static_cast<int>(number_in(texture, "index", -1)), static_cast<int>(number_in(texture, "texCoord", 0)),
          object_in(object_in(texture, "extensions"), "KHR_texture_transform")};
}

Wrap wrap_of(int mode) {
  return mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? Wrap::clamp
         : mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror
                                                         : Wrap::repeat;
}

/// The mean of a channel of a picture, 0…1.
double mean_of_channel(const image::Image& image, std::size_t channel) {
  double sum = 0;
  for (std::size_t i = channel; i < image.rgba.size(); i += 4) sum += image.rgba[i];
  return image.rgba.empty() ? 1 : sum / 255 / (static_cast<double>(image.rgba.size()) / 4);
}

}  // namespace

UvTransform GltfMaterials::uv_transform(int material) const {
  UvTransform made;
  const auto& all = source_.model.materials;
  if (material < 0 || static_cast<std::size_t>(material) >= all.size()) return made;
  const GltfTextureUse use = texture_use(all[static_cast<std::size_t>(material)]);
  if (use.index < 0) return made;
  made.set = use.uv_set;
  if (!use.transform) return made;
  for (int k = 0; k < 2; ++k) {
    if (use.transform->Get("offset").IsArray()) made.offset[k] = number_or(use.transform->Get("offset").Get(k), 0);
    if (use.transform->Get("scale").IsArray()) made.scale[k] = number_or(use.transform->Get("scale").Get(k), 1);
  }
  made.rotation = number_or(use.transform->Get("rotation"), 0);
  made.set = static_cast<int>(number_or(use.transform->Get("texCoord"), made.set));
  return made;
}

std::uint16_t GltfMaterials::index_of(int material) {
  const auto known = index_of_material_.find(material);
  if (known != index_of_material_.end()) return known->second;
  mesh::Material converted;
  WrapModes wrap;
  if (material >= 0) {
    const auto& given = entry(source_, source_.model.materials, material, fmt::format("material {}", material));
    converted = convert(given);
    wrap = wrap_modes_of(texture_use(given).index);
  }
  are_too_many_ = materials.size() >= kMaxMaterials;
  if (!are_too_many_) {
    materials.push_back(converted);
    wrap_modes.push_back(wrap);
  }
  return index_of_material_[material] = static_cast<std::uint16_t>(materials.size() - 1);
}

mesh::Material GltfMaterials::convert(const tinygltf::Material& material) {
  mesh::Material made;
  set_base_color(material, made);
  set_kind(material, made);
  set_alpha(material, made);
  if (material.normalTexture.index >= 0) left_out_.insert("bumps (normalTexture)");
  for (const char* name : {"KHR_materials_clearcoat", "KHR_materials_sheen", "KHR_materials_iridescence", "KHR_materials_anisotropy"})
    if (extension(material.extensions, name)) left_out_.insert(name);
  return made;
}

void GltfMaterials::set_base_color(const tinygltf::Material& material, mesh::Material& made) {
  const auto color = base_color(material);
  made.color = {color[0], color[1], color[2]};
  const int texture = texture_use(material).index;
  if (texture >= 0) made.texture = load_texture(texture);
}

void GltfMaterials::set_kind(const tinygltf::Material& material, mesh::Material& made) {
  const auto light = emitted(material);
  if (shows_emission(material)) {
    made.kind = mesh::MaterialKind::emissive;
    made.emission = brightest(light);
    for (std::size_t k = 0; k < 3; ++k) made.color[k] = light[k] / made.emission;
    return;
  }
  if (brightest(light) > 0) left_out_.insert("light of its own (emissive) beside a colour");
  const double transmission = number_in(extension(material.extensions, "KHR_materials_transmission"), "transmissionFactor", 0);
  if (transmission >= 0.5) {
    made.kind = mesh::MaterialKind::glass;
    made.index = std::clamp(number_in(extension(material.extensions, "KHR_materials_ior"), "ior", 1.5), 1.0, 10.0);
  } else {
    if (transmission > 0) left_out_.insert("transmission below one half");
    set_metal_or_glossy(material, made);
  }
}

void GltfMaterials::set_metal_or_glossy(const tinygltf::Material& material, mesh::Material& made) {
  if (extension(material.extensions, "KHR_materials_unlit")) return;
  if (const Value* old = specular_glossiness(material)) {
    const auto specular = color_in(old, "specularFactor");
    const double strongest = std::max({specular[0], specular[1], specular[2]}),
                 darkest = std::max({made.color[0], made.color[1], made.color[2]});
    // A black surface that reflects is a metal; specularFactor is white by default, which says nothing.
    if (!old->Has("specularFactor") || strongest < 0.2 || darkest > 0.1) return;
    made.kind = mesh::MaterialKind::metal;
    made.color = {specular[0], specular[1], specular[2]};
    made.texture = -1;
    made.roughness = 1 - share(number_in(old, "glossinessFactor", 1));
    return;
  }
  const auto& pbr = material.pbrMetallicRoughness;
  if (material.values.empty()) return;  // nothing is said of it
  double metallic = share(pbr.metallicFactor), roughness = share(pbr.roughnessFactor);
  if (pbr.metallicRoughnessTexture.index >= 0 && (metallic > 0 || roughness > 0)) {
    const auto picture = load_image_of(pbr.metallicRoughnessTexture.index);
    left_out_.insert("differences of metal and roughness inside a picture (metallicRoughnessTexture); their mean is used");
    metallic *= picture ? mean_of_channel(*picture, 2) : 0;
    roughness *= picture ? mean_of_channel(*picture, 1) : 1;
  }
  made.roughness = roughness;
  if (metallic >= 0.5) made.kind = mesh::MaterialKind::metal;
  else if (roughness < 0.5 && material.values.count("roughnessFactor")) made.kind = mesh::MaterialKind::glossy;
}

void GltfMaterials::set_alpha(const tinygltf::Material& material, mesh::Material& made) {
  const double factor = base_color(material)[3];
  if (material.alphaMode == "MASK") {
    // Alpha is that of the texture times that of the factor.
    if (made.texture >= 0) made.alpha_cutoff = factor > 0 ? std::max(0.0, material.alphaCutoff / factor) : 2;
    made.is_invisible = factor < material.alphaCutoff;
  } else if (material.alphaMode == "BLEND" && made.kind != mesh::MaterialKind::glass) {
    const auto unblended = without_blending(made, factor, made.texture >= 0 ? &textures[static_cast<std::size_t>(made.texture)] : nullptr);
    made = unblended.material;
    is_blended_ = is_blended_ || !unblended.is_exact;
  }
}

WrapModes GltfMaterials::wrap_modes_of(int texture) const {
  const auto& model = source_.model;
  if (texture < 0 || static_cast<std::size_t>(texture) >= model.textures.size()) return {};
  const int sampler = model.textures[static_cast<std::size_t>(texture)].sampler;
  if (sampler < 0 || static_cast<std::size_t>(sampler) >= model.samplers.size()) return {};
  return {wrap_of(model.samplers[static_cast<std::size_t>(sampler)].wrapS),
          wrap_of(model.samplers[static_cast<std::size_t>(sampler)].wrapT)};
}

Diagnostics GltfMaterials::warnings() const {
  Diagnostics all = texture_warnings_;
  const auto& name = source_.context.name;
  if (are_too_many_)
    all.push_back(make_warning("mesh.too-many-looks",
                               fmt::format("{}: more than {} materials; the others look like the last one", name, kMaxMaterials)));
  if (is_blended_) all.push_back(blending_warning(name));
  for (const auto& what : left_out_)
    all.push_back(make_warning("mesh.ignored", fmt::format("{}: its materials have {}; left out", name, what)));
  return all;
}

int GltfMaterials::load_texture(int texture) {
  const auto known = index_of_texture_.find(texture);
  if (known != index_of_texture_.end()) return known->second;
  auto picture = load_image_of(texture);
  if (!picture) {
    const auto& reason = picture.error().front();
    texture_warnings_.push_back(
        make_warning("mesh.bad-texture", fmt::format("{}: a texture is left out: {}", source_.context.name, reason.message), reason.hint));
    return index_of_texture_[texture] = -1;
  }
  textures.push_back(*std::move(picture));
  return index_of_texture_[texture] = static_cast<int>(textures.size()) - 1;
}

Result<image::Image> GltfMaterials::load_image_of(int texture) const {
  const auto& given = entry(source_, source_.model.textures, texture, fmt::format("texture {}", texture));
  if (given.source >= 0) return load_image(given.source);
  for (const char* name : {"EXT_texture_webp", "KHR_texture_basisu", "MSFT_texture_dds", "EXT_texture_avif"}) {
    const Value* other = extension(given.extensions, name);
    if (!other) continue;
    auto picture = load_image(static_cast<int>(number_in(other, "source", -1)));
    if (picture) return picture;
    return make_error("mesh.bad-texture", fmt::format("its pictures are stored by {}", name), "export them as PNG or JPEG");
  }
  return make_error("mesh.bad-texture", fmt::format("texture {} has no picture", texture));
}

Result<image::Image> GltfMaterials::load_image(int index) const {
  const auto& images = source_.model.images;
  if (index < 0 || static_cast<std::size_t>(index) >= images.size())
    return make_error("mesh.bad-texture", fmt::format("image {} is not there", index));
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
