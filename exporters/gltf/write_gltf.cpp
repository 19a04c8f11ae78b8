// One primitive for all copies: importers pay by the node and the material (5,000 of each take Blender 106 s, one primitive 1.2 s), hence
// the weights per vertex. KHR_materials_unlit with baseColorTexture is the one form that Blender 3.4 draws with exact colours. doubleSided,
// because every other copy is a mirror image and turns its triangles around. glTF (x, y, z) is Blender's (x, −z, y).
// Sources: glTF 2.0 specification (Khronos), §3.6–3.11, §4.4 (GLB); renderers study §8–10.
#include "exporters/gltf/write_gltf.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <stdexcept>

#include "compiler/base/check.h"
#include "compiler/base/elementary.h"
#include "compiler/image_io/png.h"
#include "exporters/gltf/json.h"
#include "exporters/gltf/layout.h"
#include "exporters/side_file.h"
#include "exporters/standpoint.h"

namespace orbc::gltf {
namespace {

using driver::ProductCopy;
using driver::Product;
using geometry::Vector3;

enum : int { kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126, kArrayBuffer = 34962, kElementArrayBuffer = 34963 };
enum : int { kNearest = 9728, kLinear = 9729, kClampToEdge = 33071 };

/// Where each bufferView and accessor stands in its list; the same rule writes them and refers to them.
struct Numbering {
  int normal = -1, uv = -1, color = -1, indices = 1, atlas = -1;  // bufferViews; positions are 0
  int per_part = 2;                                               // accessors of a part: position, [normal], [uv], [colour], indices
};

Numbering numbering(const Layout& layout) {
  Numbering n;
  int view = 1;
  if (layout.has_normals) n.normal = view++, ++n.per_part;
  if (layout.has_uv) n.uv = view++, ++n.per_part;
  if (layout.has_color) n.color = view++, ++n.per_part;
  n.indices = view++;
  n.atlas = layout.parts.empty() ? 0 : view;
  return n;
}

std::string copy_name(const ProductCopy& copy) { return copy.word.empty() ? "room" : "copy " + cover::to_string(copy.word); }

const char* projection_name(scene::Projection projection) {
  return projection == scene::Projection::perspective ? "perspective" : projection == scene::Projection::panorama ? "panorama" : "cylinder";
}

std::array<float, 3> floats(const scene::Color& c) { return {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)}; }

void write_copy_facts(Json& json, const ProductCopy& copy) {
  json.key("word").string(cover::to_string(copy.word));
  json.key("bounces").number(copy.bounces).key("sheet").number(copy.sheet);
  json.key("reversing").boolean(copy.reversing);
  json.key("weight").numbers(floats(copy.weight));
  json.key("distance").number(copy.distance).key("level").number(copy.level);
}

void write_camera(Json& json, const Product& product) {
  const place::Camera& eye = product.eye;
  const double aspect = static_cast<double>(eye.width) / eye.height;
  // What glTF has no camera for gets the nearest perspective; the extras carry the truth.
  double half = 1;
  if (eye.projection == scene::Projection::perspective) half = math::tan(eye.fov.radians / 2) / aspect;
  if (eye.projection == scene::Projection::cylinder) half = eye.fov.radians / 2 / aspect;
  json.key("cameras").array().object();
  json.key("type").string("perspective").key("perspective").object();
  json.key("yfov").number(2 * math::atan(half)).key("aspectRatio").number(aspect).key("znear").number(0.01);
  json.end_object();
  json.key("extras").object();
  json.key("orbc_projection").string(projection_name(eye.projection));
  json.key("orbc_width").number(eye.width).key("orbc_height").number(eye.height);
  json.key("orbc_fov_deg").number(static_cast<float>(eye.fov.degrees()));
  json.key("orbc_background").numbers(floats(product.background));
  if (product.scale != 1) json.key("orbc_scale").number(product.scale);
  json.end_object().end_object().end_array();
}

/// The camera looks along its −z; columns right, up, −forward, location, each in glTF's axes.
void write_camera_node(Json& json, const Product& product) {
  const exporters::Standpoint at = exporters::standpoint(product);
  json.object().key("name").string("camera").key("camera").number(0).key("matrix").array();
  const auto column = [&](const Vector3& v, int last) { json.number(v.x).number(v.z).number(0 - v.y).number(last); };
  column(at.right, 0);
  column(at.up, 0);
  column(-1.0 * at.forward, 0);
  column(at.location, 1);
  json.end_array().end_object();
}

void write_primitive(Json& json, const Layout& layout, std::size_t part, std::size_t material) {
  const Numbering n = numbering(layout);
  int accessor = static_cast<int>(part) * n.per_part;
  json.object().key("attributes").object().key("POSITION").number(accessor++);
  if (layout.has_normals) json.key("NORMAL").number(accessor++);
  if (layout.has_uv) json.key("TEXCOORD_0").number(accessor++);
  if (layout.has_color) json.key("COLOR_0").number(accessor++);
  json.end_object().key("indices").number(accessor).key("material").number(material).end_object();
}

/// Parts that stand in one mesh, under one name.
struct Group {
  std::string name;
  std::size_t first_part = 0, part_count = 0, copies = 0;
};

/// One group for all, or one an object. The parts of an object follow one another.
std::vector<Group> groups_of(const Product& product, const Layout& layout) {
  std::vector<Group> groups;
  for (std::size_t p = 0; p < layout.parts.size(); ++p) {
    const Part& part = layout.parts[p];
    if (groups.empty() || part.object != layout.parts[p - 1].object)
      groups.push_back({part.object ? product.objects[*part.object] : "copies", p, 0, 0});
    ++groups.back().part_count;
    groups.back().copies += part.copy_count;
  }
  return groups;
}

/// The number of a group's material: for what glows, and, where lamps light the rest, for that.
std::size_t material_of(std::size_t group, bool native, bool glows) { return native ? 2 * group + (glows ? 0 : 1) : group; }

void write_group_mesh(Json& json, const Layout& layout, const Group& group, std::size_t number, bool native) {
  json.object().key("name").string(group.name).key("primitives").array();
  for (std::size_t p = group.first_part; p < group.first_part + group.part_count; ++p)
    write_primitive(json, layout, p, material_of(number, native, layout.parts[p].glows));
  json.end_array().end_object();
}

void write_group_node(Json& json, const Group& group, std::size_t mesh, bool by_object) {
  json.object().key("name").string(group.name).key("mesh").number(mesh);
  if (by_object) json.key("extras").object().key("orbc_object").string(group.name).key("orbc_copies").number(group.copies).end_object();
  json.end_object();
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

/// The distinct materials, in order of first use, and which one each part has. A joint mesh has its weights per vertex.
struct Tints {
  struct Material {
    scene::Color color{1, 1, 1};
    bool glows = true;
    std::string name = "atlas";
  };
  std::vector<Material> materials;
  std::vector<std::size_t> of_part;
};

Tints collect_tints(const Product& product, const Layout& layout, bool per_copy, const std::vector<Group>& groups) {
  Tints tints;
  if (!per_copy) {
    for (const Group& group : groups) {
      const std::string name = layout.parts[group.first_part].object ? group.name : "atlas";
      tints.materials.push_back({{1, 1, 1}, true, name});
      if (product.native) tints.materials.push_back({{1, 1, 1}, false, name});
    }
    return tints;
  }
  std::map<std::array<double, 4>, std::size_t> known;
  for (const Part& part : layout.parts) {
    // Lamps bring the weights of the copies that they light.
    const scene::Color c = part.glows ? product.copies[part.first_copy].weight : scene::Color{1, 1, 1};
    const auto [entry, is_new] = known.try_emplace({c.r, c.g, c.b, part.glows ? 1.0 : 0.0}, tints.materials.size());
    if (is_new) tints.materials.push_back({c, part.glows, "atlas"});
    tints.of_part.push_back(entry->second);
  }
  return tints;
}

/// The lamps that are no image of another copy's.
std::vector<native_lights::NativeLamp> own_lamps(const Product& product) {
  std::vector<native_lights::NativeLamp> own;
  if (product.native)
    std::copy_if(product.native->lamps.begin(), product.native->lamps.end(), std::back_inserter(own),
                 [](const native_lights::NativeLamp& l) { return l.direct; });
  return own;
}

bool is_cone(const native_lights::NativeLamp& lamp) {
  return lamp.kind == scene::LampKind::spot || lamp.kind == scene::LampKind::disk || lamp.kind == scene::LampKind::rectangle;
}

/// KHR_lights_punctual: points and cones, in candela. A white surface, face on at distance r, is to show intensity/r²: that is I/(π r²) of
/// a radiant intensity I, and at 683 lm/W, as Blender takes it, 683·π candela for each. Plates become the widest cones there are.
void write_lights(Json& json, const std::vector<native_lights::NativeLamp>& lamps) {
  constexpr double kLumensPerWatt = 683;
  json.key("extensions").object().key("KHR_lights_punctual").object().key("lights").array();
  for (const native_lights::NativeLamp& lamp : lamps) {
    const double most = scene::max_channel(lamp.intensity), whole = most > 0 ? most : 1;
    json.object().key("type").string(is_cone(lamp) ? "spot" : "point");
    json.key("color").numbers(floats((1 / whole) * lamp.intensity));
    json.key("intensity").number(kLumensPerWatt * std::numbers::pi * most);
    if (lamp.kind != scene::LampKind::tube && geometry::length(lamp.half_u) > 0)  // glTF knows no size; scripts/render_blender.py does
      json.key("extras")
          .object()
          .key("orbc_radius")
          .number(static_cast<float>(std::sqrt(geometry::length(lamp.half_u) * geometry::length(lamp.half_v))))
          .end_object();
    if (is_cone(lamp)) {
      const bool spot = lamp.kind == scene::LampKind::spot;
      const double outer = spot ? std::min(math::acos(lamp.cone_outer), std::numbers::pi / 2) : std::numbers::pi / 2;
      json.key("spot").object().key("innerConeAngle").number(spot ? std::min(math::acos(lamp.cone_inner), 0.999 * outer) : 0.0);
      json.key("outerConeAngle").number(outer).end_object();
    }
    json.end_object();
  }
  json.end_array().end_object().end_object();
}

/// A lamp shines along its −z: columns of any frame whose third is against its axis, in glTF's axes.
void write_lamp_node(Json& json, const native_lights::NativeLamp& lamp, std::size_t number) {
  const Vector3 back = -1.0 * lamp.axis;
  const Vector3 right = geometry::normalised(geometry::cross(std::fabs(back.z) < 0.9 ? Vector3{0, 0, 1} : Vector3{1, 0, 0}, back));
  json.object().key("name").string("lamp").key("matrix").array();
  const auto column = [&](const Vector3& v, int last) { json.number(v.x).number(v.z).number(0 - v.y).number(last); };
  column(right, 0);
  column(geometry::cross(back, right), 0);
  column(back, 0);
  column(lamp.at, 1);
  json.end_array()
      .key("extensions")
      .object()
      .key("KHR_lights_punctual")
      .object()
      .key("light")
      .number(number)
      .end_object()
      .end_object()
      .end_object();
}

void write_materials(Json& json, const Layout& layout, const Tints& tints, const std::string& atlas_uri, bool interpolate, bool masked) {
  json.key("materials").array();
  for (const auto& [tint, glows, name] : tints.materials) {
    json.object().key("name").string(name).key("doubleSided").boolean(true);
    if (masked) json.key("alphaMode").string("MASK").key("alphaCutoff").number(0.5);
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
  const int filter = interpolate ? kLinear : kNearest;
  json.key("textures").array().object().key("sampler").number(0).key("source").number(0).end_object().end_array();
  json.key("samplers").array().object().key("magFilter").number(filter).key("minFilter").number(filter);
  json.key("wrapS").number(kClampToEdge).key("wrapT").number(kClampToEdge).end_object().end_array();
  json.key("images").array().object().key("name").string("atlas");
  if (atlas_uri.empty()) json.key("bufferView").number(numbering(layout).atlas).key("mimeType").string("image/png");
  else json.key("uri").string(atlas_uri);
  json.end_object().end_array();
}

void write_accessors(Json& json, const Layout& layout) {
  const Numbering n = numbering(layout);
  const auto head = [&](int view, std::size_t offset, int component, std::size_t count, const char* type) {
    json.object().key("bufferView").number(view);
    if (offset) json.key("byteOffset").number(offset);
    json.key("componentType").number(component).key("count").number(count).key("type").string(type);
  };
  json.key("accessors").array();
  for (const Part& part : layout.parts) {
    head(0, part.position_at, kFloat, part.vertex_count, "VEC3");
    json.key("min").numbers(part.low).key("max").numbers(part.high).end_object();
    if (layout.has_normals) head(n.normal, part.normal_at, kFloat, part.vertex_count, "VEC3"), json.end_object();
    if (layout.has_uv) head(n.uv, part.uv_at, kFloat, part.vertex_count, "VEC2"), json.end_object();
    if (layout.has_color) {
      head(n.color, part.color_at, kUnsignedShort, part.vertex_count, "VEC4");
      json.key("normalized").boolean(true).end_object();
    }
    head(n.indices, part.index_at, part.index_bytes == 2 ? kUnsignedShort : kUnsignedInt, part.index_count, "SCALAR");
    json.end_object();
  }
  json.end_array();
}

void write_buffers(Json& json, const Layout& layout, const std::string& bin_uri) {
  const auto view = [&](std::size_t offset, std::size_t length, int stride, int target) {
    json.object().key("buffer").number(0);
    if (offset) json.key("byteOffset").number(offset);
    json.key("byteLength").number(length);
    if (stride) json.key("byteStride").number(stride);
    if (target) json.key("target").number(target);
    json.end_object();
  };
  json.key("bufferViews").array();
  view(0, layout.position_bytes, 12, kArrayBuffer);
  if (layout.has_normals) view(layout.normal_at, layout.normal_bytes, 12, kArrayBuffer);
  if (layout.has_uv) view(layout.uv_at, layout.uv_bytes, 8, kArrayBuffer);
  if (layout.has_color) view(layout.color_at, layout.color_bytes, 8, kArrayBuffer);
  view(layout.index_at, layout.index_bytes, 0, kElementArrayBuffer);
  if (layout.atlas_bytes) view(layout.atlas_at, layout.atlas_bytes, 0, 0);
  json.end_array();
  json.key("buffers").array().object().key("byteLength").number(layout.total_bytes);
  if (!bin_uri.empty()) json.key("uri").string(bin_uri);
  json.end_object().end_array();
}

struct Uris {
  std::string bin, atlas;  // empty = inside the GLB
};

std::string make_json(const Product& product, const Layout& layout, const GltfOptions& options, const Uris& uris) {
  const bool drawn = !layout.parts.empty();
  const std::vector<Group> groups = groups_of(product, layout);
  const Tints tints = collect_tints(product, layout, options.nodes_per_copy, groups);
  std::string out;
  out.reserve(4096 + 192 * product.copies.size());
  exporters::Pen pen(out);
  Json json(pen);
  json.object();
  json.key("asset").object().key("version").string("2.0").key("generator").string("orbc").end_object();
  const std::vector<native_lights::NativeLamp> lamps = own_lamps(product);
  if (drawn) {
    json.key("extensionsUsed").array().string("KHR_materials_unlit");
    if (product.native) json.string("KHR_materials_specular");
    if (!lamps.empty()) json.string("KHR_lights_punctual");
    json.end_array();
  }
  if (drawn && !lamps.empty()) write_lights(json, lamps);
  json.key("scene").number(0).key("scenes").array().object().key("name").string(product.title).key("nodes").array().number(0);
  // After the camera: one node a group, or one that holds those of all copies.
  for (std::size_t g = 0; g < (options.nodes_per_copy && drawn ? 1 : groups.size()); ++g) json.number(g + 1);
  const std::size_t first_lamp = options.nodes_per_copy ? layout.parts.size() + 2 : groups.size() + 1;
  for (std::size_t i = 0; drawn && i < lamps.size(); ++i) json.number(first_lamp + i);
  json.end_array().end_object().end_array();

  json.key("nodes").array();
  write_camera_node(json, product);
  for (std::size_t g = 0; !options.nodes_per_copy && g < groups.size(); ++g) write_group_node(json, groups[g], g, options.nodes_per_object);
  if (drawn && options.nodes_per_copy) {
    json.object().key("name").string("copies").key("children").array();
    for (std::size_t p = 0; p < layout.parts.size(); ++p) json.number(p + 2);
    json.end_array().end_object();
    for (std::size_t p = 0; p < layout.parts.size(); ++p) {
      const ProductCopy& copy = product.copies[layout.parts[p].first_copy];
      json.object().key("name").string(copy_name(copy)).key("mesh").number(p).key("extras").object();
      write_copy_facts(json, copy);
      json.end_object().end_object();
    }
  }
  for (std::size_t i = 0; drawn && i < lamps.size(); ++i) write_lamp_node(json, lamps[i], i);
  json.end_array();
  write_camera(json, product);

  if (drawn) {
    json.key("meshes").array();
    for (std::size_t g = 0; !options.nodes_per_copy && g < groups.size(); ++g)
      write_group_mesh(json, layout, groups[g], g, product.native.has_value());
    for (std::size_t p = 0; options.nodes_per_copy && p < layout.parts.size(); ++p) {
      json.object().key("name").string(copy_name(product.copies[layout.parts[p].first_copy])).key("primitives").array();
      write_primitive(json, layout, p, tints.of_part[p]);
      json.end_array().end_object();
    }
    json.end_array();
    write_materials(json, layout, tints, uris.atlas, options.interpolate || product.bilinear_atlas, product.masked);
    write_accessors(json, layout);
    write_buffers(json, layout, uris.bin);
    if (!options.nodes_per_copy) write_ranges(json, product, layout, groups);
  }
  json.end_object();
  pen.flush();
  return out;
}

void append_u32(std::string& out, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 255);
}

void append_atlas(const Layout& layout, const std::string& png, std::string& out) {
  if (layout.atlas_bytes == 0) return;
  out += png;
  out.append(layout.total_bytes - layout.atlas_at - png.size(), '\0');
}

/// Header, JSON chunk padded with spaces, binary chunk padded with zeros (glTF 2.0 §4.4).
std::string make_glb(const Product& product, const Layout& layout, const std::string& png, std::string json) {
  json.append((4 - json.size() % 4) % 4, ' ');
  const bool has_bin = layout.total_bytes > 0;
  const std::size_t total = 12 + 8 + json.size() + (has_bin ? 8 + layout.total_bytes : 0);
  if (total > 0xFFFFFFFFu)
    throw std::length_error("a GLB file holds less than 4 GiB, this one would need " + std::to_string(total) +
                            " bytes; write .gltf instead");
  std::string out;
  out.reserve(total);
  out += "glTF";
  append_u32(out, 2);
  append_u32(out, total);
  append_u32(out, json.size());
  out += "JSON";
  out += json;
  json = {};
  if (has_bin) {
    append_u32(out, layout.total_bytes);
    out.append("BIN\0", 4);
    append_geometry(product, layout, out);
    append_atlas(layout, png, out);
  }
  ORBC_CHECK(out.size(), ==, total);
  return out;
}

std::string atlas_png(const Product& product) {
  ORBC_CHECK(static_cast<int>(product.depth), !=, static_cast<int>(scene::AtlasFormat::exr));
  if (product.atlas16.rgb.empty()) return image_io::encode_png(product.atlas);
  return image_io::encode_png(product.atlas16, product.masked ? &product.atlas : nullptr);
}

}  // namespace

std::vector<driver::File> write_gltf(const Product& product, const GltfOptions& options) {
  ORBC_CHECK(product.uv.size(), ==, product.positions.size());
  ORBC_CHECK(options.nodes_per_object && (options.nodes_per_copy || (product.objects.empty() && !product.copies.empty())), ==, false);
  const bool drawn =
      std::any_of(product.copies.begin(), product.copies.end(), [](const ProductCopy& c) { return c.vertex_count && c.index_count; });
  std::string png;
  if (drawn && !product.atlas.rgba.empty()) png = atlas_png(product);
  const Layout layout = make_layout(product, options.nodes_per_copy, options.binary ? png.size() : 0);

  std::vector<driver::File> files;
  if (options.binary) {
    files.push_back({"", make_glb(product, layout, png, make_json(product, layout, options, {}))});
    return files;
  }
  std::string bin;
  if (layout.total_bytes > 0) {
    bin.reserve(layout.total_bytes);
    append_geometry(product, layout, bin);
  }
  const Uris uris{exporters::side_file_name({options.name, "gltf", "", ".bin"}, bin),
                  exporters::side_file_name({options.name, "gltf", "-atlas", ".png"}, png)};
  files.push_back({"", make_json(product, layout, options, uris)});
  if (!bin.empty()) files.push_back({uris.bin, std::move(bin)});
  if (!png.empty()) files.push_back({uris.atlas, std::move(png)});
  return files;
}

std::uint64_t bytes_of(const driver::Amount& amount) {
  constexpr std::uint64_t kHead = 2500, kCopy = 190;  // of JSON, measured
  const std::uint64_t vertex = amount.normals ? 40 : 28, index = amount.vertices <= 65535 ? 2 : 4;
  return kHead + kCopy * amount.copies + vertex * amount.vertices + 3 * index * amount.triangles;
}

}  // namespace orbc::gltf
