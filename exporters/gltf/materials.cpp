#include "exporters/gltf/materials.h"

#include <algorithm>
#include <array>
#include <map>

#include "exporters/gltf/buffers.h"

namespace orbc::gltf {
namespace {

enum : int { kNearest = 9728, kLinear = 9729, kClampToEdge = 33071 };

}  // namespace

MaterialTable collect_materials(const driver::Product& product, const Layout& layout, bool per_copy, const std::vector<Group>& groups) {
  MaterialTable table;
  if (!per_copy) {
    for (const Group& group : groups) {
      const std::string name = layout.parts[group.first_part].object ? group.name : "atlas";
      table.materials.push_back({{1, 1, 1}, true, name});
      if (product.native) table.materials.push_back({{1, 1, 1}, false, name});
    }
    return table;
  }
  std::map<std::array<double, 4>, std::size_t> known;
  for (const Part& part : layout.parts) {
    // Lamps bring the weights of the copies that they light.
    const scene::Color c = part.glows ? product.copies[part.first_copy].weight : scene::Color{1, 1, 1};
    const auto [entry, is_new] = known.try_emplace({c.r, c.g, c.b, part.glows ? 1.0 : 0.0}, table.materials.size());
    if (is_new) table.materials.push_back({c, part.glows, "atlas"});
    table.of_part.push_back(entry->second);
  }
  return table;
}

void write_materials(Json& json, const Layout& layout, const MaterialTable& table, const AtlasReference& atlas) {
  json.key("materials").array();
  for (const auto& [tint, glows, name] : table.materials) {
    json.object().key("name").string(name).key("doubleSided").boolean(true);
    if (atlas.masked) json.key("alphaMode").string("MASK").key("alphaCutoff").number(0.5);
    json.key("pbrMetallicRoughness").object();
    if (layout.has_uv) json.key("baseColorTexture").object().key("index").number(0).end_object();
    if (tint.r != 1 || tint.g != 1 || tint.b != 1) {
      json.key("baseColorFactor").array();
      for (const double v : {tint.r, tint.g, tint.b, 1.0}) json.number(std::clamp(v, 0.0, 1.0));
      json.end_array();
    }
    // Glowing: for viewers that do not know unlit. Lit: without its highlights Blender's principled surface is nearest to Lambert's at one
    // half.
    json.key("metallicFactor").number(0).key("roughnessFactor").number(glows ? 1 : 0.5).end_object();
    json.key("extensions").object();
    if (glows) json.key("KHR_materials_unlit").object().end_object();
    else json.key("KHR_materials_specular").object().key("specularFactor").number(0).end_object();  // matte
    json.end_object().end_object();
  }
  json.end_array();
  if (!layout.has_uv) return;
  const int filter = atlas.interpolated ? kLinear : kNearest;
  json.key("textures").array().object().key("sampler").number(0).key("source").number(0).end_object().end_array();
  json.key("samplers").array().object().key("magFilter").number(filter).key("minFilter").number(filter);
  json.key("wrapS").number(kClampToEdge).key("wrapT").number(kClampToEdge).end_object().end_array();
  json.key("images").array().object().key("name").string("atlas");
  if (atlas.uri.empty()) json.key("bufferView").number(atlas_view(layout)).key("mimeType").string("image/png");
  else json.key("uri").string(atlas.uri);
  json.end_object().end_array();
}

}  // namespace orbc::gltf
