#include "exporters/gltf/document.h"

#include "exporters/gltf/buffers.h"
#include "exporters/gltf/camera.h"
#include "exporters/gltf/pose.h"
#include "exporters/gltf/groups.h"
#include "exporters/gltf/json.h"
#include "exporters/gltf/lamps.h"
#include "exporters/gltf/materials.h"

namespace orbc::gltf {
namespace {

using driver::Product;
using driver::ProductCopy;

/// What the document is made of.
struct Document {
  const Product& product;
  const Layout& layout;
  const GltfOptions& options;
  std::vector<Group> groups;
  MaterialTable materials;
  std::vector<native_lights::NativeLamp> lamps;

  [[nodiscard]] bool is_drawn() const { return !layout.parts.empty(); }
};

std::string copy_name(const ProductCopy& copy) { return copy.word.empty() ? "room" : "copy " + cover::to_string(copy.word); }

void write_copy_facts(Json& json, const ProductCopy& copy) {
  json.key("word").string(cover::to_string(copy.word));
  json.key("bounces").number(copy.bounces).key("sheet").number(copy.sheet);
  json.key("reversing").boolean(copy.reversing);
  json.key("weight").numbers(floats(copy.weight));
  json.key("distance").number(copy.distance).key("level").number(copy.level);
}

void write_group_mesh(Json& json, const Layout& layout, const Group& group, std::size_t number, bool native) {
  json.object().key("name").string(group.name).key("primitives").array();
  for (std::size_t p = group.first_part; p < group.first_part + group.part_count; ++p)
    write_primitive(json, layout, p, material_of_group(number, native, layout.parts[p].glows));
  json.end_array().end_object();
}

void write_group_node(Json& json, const Group& group, std::size_t mesh, bool by_object) {
  json.object().key("name").string(group.name).key("mesh").number(mesh);
  if (by_object) json.key("extras").object().key("orbc_object").string(group.name).key("orbc_copies").number(group.copies).end_object();
  json.end_object();
}

void write_extensions(Json& json, const Document& document) {
  json.key("extensionsUsed").array().string("KHR_materials_unlit");
  if (document.product.native) json.string("KHR_materials_specular");
  if (!document.lamps.empty()) json.string("KHR_lights_punctual");
  json.end_array();
  if (!document.lamps.empty()) write_lights(json, document.lamps);
}

/// The roots of the scene: the camera, a node for each group or one that holds those of all copies, the lamps.
void write_scene(Json& json, const Document& document) {
  const bool per_copy = document.options.nodes_per_copy;
  const std::size_t groups = document.groups.size();
  json.key("scene").number(0).key("scenes").array().object();
  json.key("name").string(document.product.title).key("nodes").array().number(0);
  for (std::size_t g = 0; g < (per_copy && document.is_drawn() ? 1 : groups); ++g) json.number(g + 1);
  const std::size_t first_lamp = per_copy ? document.layout.parts.size() + 2 : groups + 1;
  for (std::size_t i = 0; document.is_drawn() && i < document.lamps.size(); ++i) json.number(first_lamp + i);
  json.end_array().end_object().end_array();
}

void write_copy_nodes(Json& json, const Document& document) {
  json.object().key("name").string("copies").key("children").array();
  for (std::size_t p = 0; p < document.layout.parts.size(); ++p) json.number(p + 2);
  json.end_array().end_object();
  for (std::size_t p = 0; p < document.layout.parts.size(); ++p) {
    const ProductCopy& copy = document.product.copies[document.layout.parts[p].first_copy];
    json.object().key("name").string(copy_name(copy)).key("mesh").number(p).key("extras").object();
    write_copy_facts(json, copy);
    json.end_object().end_object();
  }
}

void write_nodes(Json& json, const Document& document) {
  json.key("nodes").array();
  write_camera_node(json, document.product);
  if (!document.options.nodes_per_copy)
    for (std::size_t g = 0; g < document.groups.size(); ++g)
      write_group_node(json, document.groups[g], g, document.options.nodes_per_object);
  else if (document.is_drawn()) write_copy_nodes(json, document);
  for (std::size_t i = 0; document.is_drawn() && i < document.lamps.size(); ++i) write_lamp_node(json, document.lamps[i], i);
  json.end_array();
}

void write_meshes(Json& json, const Document& document) {
  json.key("meshes").array();
  if (!document.options.nodes_per_copy) {
    for (std::size_t g = 0; g < document.groups.size(); ++g)
      write_group_mesh(json, document.layout, document.groups[g], g, document.product.native.has_value());
  } else {
    for (std::size_t p = 0; p < document.layout.parts.size(); ++p) {
      const ProductCopy& copy = document.product.copies[document.layout.parts[p].first_copy];
      json.object().key("name").string(copy_name(copy)).key("primitives").array();
      write_primitive(json, document.layout, p, document.materials.of_part[p]);
      json.end_array().end_object();
    }
  }
  json.end_array();
}

/// Which triangles of the joint mesh belong to which copy. At the root, because Blender turns the extras of a mesh into properties, 11 KB a
/// copy.
void write_ranges(Json& json, const Product& product, const Layout& layout, const std::vector<Group>& groups) {
  json.key("extras").object().key("orbc_copies").array();
  for (const Group& group : groups) {
    for (std::size_t p = group.first_part; p < group.first_part + group.part_count; ++p) {
      const Part& part = layout.parts[p];
      for (std::size_t c = part.first_copy; c < part.first_copy + part.copy_count; ++c) {
        const ProductCopy& copy = product.copies[c];
        if (copy.vertex_count == 0 || copy.index_count == 0) continue;
        json.object();
        write_copy_facts(json, copy);
        if (part.object) json.key("object").string(group.name);
        json.key("primitive").number(p - group.first_part);
        json.key("first_index").number(copy.first_index - part.first_index).key("index_count").number(copy.index_count);
        json.end_object();
      }
    }
  }
  json.end_array().end_object();
}

}  // namespace

std::string make_json(const Product& product, const Layout& layout, const GltfOptions& options, const Uris& uris) {
  std::vector<Group> groups = groups_of(product, layout);
  MaterialTable materials = collect_materials(product, layout, options.nodes_per_copy, groups);
  const Document document{product, layout, options, std::move(groups), std::move(materials), own_lamps(product)};
  std::string out;
  out.reserve(4096 + 192 * product.copies.size());
  exporters::Pen pen(out);
  Json json(pen);
  json.object();
  json.key("asset").object().key("version").string("2.0").key("generator").string("orbc").end_object();
  if (document.is_drawn()) write_extensions(json, document);
  write_scene(json, document);
  write_nodes(json, document);
  write_camera(json, product);
  if (document.is_drawn()) {
    write_meshes(json, document);
    write_materials(json, layout, document.materials, {uris.atlas, options.interpolate || product.bilinear_atlas, product.masked});
    write_accessors(json, layout);
    write_buffers(json, layout, uris.bin);
    if (!options.nodes_per_copy) write_ranges(json, product, layout, document.groups);
  }
  json.end_object();
  pen.flush();
  return out;
}

}  // namespace orbc::gltf
