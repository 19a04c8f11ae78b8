#include "exporters/gltf/buffers.h"

namespace orbc::gltf {
namespace {

enum : int { kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126, kArrayBuffer = 34962, kElementArrayBuffer = 34963 };

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

}  // namespace

void write_primitive(Json& json, const Layout& layout, std::size_t part, std::size_t material) {
  const Numbering n = numbering(layout);
  int accessor = static_cast<int>(part) * n.per_part;
  json.object().key("attributes").object().key("POSITION").number(accessor++);
  if (layout.has_normals) json.key("NORMAL").number(accessor++);
  if (layout.has_uv) json.key("TEXCOORD_0").number(accessor++);
  if (layout.has_color) json.key("COLOR_0").number(accessor++);
  json.end_object().key("indices").number(accessor).key("material").number(material).end_object();
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

int atlas_view(const Layout& layout) { return numbering(layout).atlas; }

}  // namespace orbc::gltf
