// The vertices and faces of a PLY file, with any other properties and elements between them. Triangle strips (Stanford) become triangles.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "compiler/mesh_io/colors.h"
#include "compiler/mesh_io/errors.h"
#include "compiler/mesh_io/ply_header.h"
#include "compiler/mesh_io/readers.h"
#include "compiler/mesh_io/texture_loader.h"
#include "compiler/mesh_io/tokens.h"

namespace orbc::mesh_io {
namespace {

/// What a property is to a mesh: a single value by its slot, a list, or nothing.
enum Slot : std::size_t { kX, kY, kZ, kU, kV, kRed, kGreen, kBlue, kTexture, kSingleSlots, kIndices, kTexcoords, kNothing };

Slot color_slot_of(const std::string& name) {
  if (name == "red" || name == "r" || name == "diffuse_red") return kRed;
  if (name == "green" || name == "g" || name == "diffuse_green") return kGreen;
  if (name == "blue" || name == "b" || name == "diffuse_blue") return kBlue;
  return kNothing;
}

Slot slot_of(const PlyElement& element, const PlyProperty& property) {
  const bool is_list = property.count_type != PlyType::none;
  const auto& n = property.name;
  if (element.name == "face" && !is_list) return n == "texnumber" || n == "texture_index" ? kTexture : color_slot_of(n);
  if (element.name == "vertex" && !is_list) {
    if (n == "x") return kX;
    if (n == "y") return kY;
    if (n == "z") return kZ;
    if (n == "u" || n == "s" || n == "texture_u" || n == "texture_s") return kU;
    if (n == "v" || n == "t" || n == "texture_v" || n == "texture_t") return kV;
    return color_slot_of(n);
  }
  if ((element.name == "face" || element.name == "tristrips") && is_list) {
    if (n == "vertex_indices" || n == "vertex_index") return kIndices;
    if (n == "texcoord" && element.name == "face") return kTexcoords;
  }
  return kNothing;
}

/// One entry of an element, its values sorted by what they are.
struct Entry {
  std::array<double, kSingleSlots> values{};
  std::vector<double> indices, texcoords;
};

/// The file as far as it has been read.
struct PlyData {
  PolygonSoup soup;
  std::uint64_t vertex_count = 0;
  bool has_vertices = false, has_vertex_uv = false;
  float vertex_white = 0, face_white = 0;  ///< the value of full light; 0: there are no colours, −1: the file does not say
  bool has_face_textures = false;
  bool every_face_has_uv = true;
  std::vector<std::array<float, 2>> vertex_uv;
  std::vector<double> face_texture;  ///< of each face, index of its texture
};

std::array<bool, kSingleSlots> single_slots(const PlyElement& element) {
  std::array<bool, kSingleSlots> has{};
  for (const auto& p : element.properties) {
    if (const auto slot = slot_of(element, p); slot < kSingleSlots) has[slot] = true;
  }
  return has;
}

/// What stands for full light in the colours of an element: 0 when it has none, −1 when their type does not say.
float white_of_element(const PlyElement& element) {
  const auto has = single_slots(element);
  if (!has[kRed] || !has[kGreen] || !has[kBlue]) return 0;
  for (const auto& p : element.properties) {
    if (slot_of(element, p) != kRed) continue;
    if (p.type == PlyType::u8) return 255;
    if (p.type == PlyType::u16) return 65535;
  }
  return -1;
}

Diagnostics check_vertex_element(const PlyElement& element, PlyData& data, const ReadContext& context) {
  if (data.has_vertices) return {make_error("mesh.bad-header", fmt::format("{}: two elements \"vertex\"", context.name))};
  data.has_vertices = true;
  data.vertex_count = element.count;
  const auto has = single_slots(element);
  if (!has[kX] || !has[kY] || !has[kZ])
    return {make_error("mesh.bad-header", fmt::format("{}: the vertices have no x, y, z", context.name))};
  data.has_vertex_uv = has[kU] && has[kV];
  data.vertex_white = white_of_element(element);
  return {};
}

}  // namespace

Diagnostics check_ply_size(const PlyHeader& header, const ReadContext& context) {
  for (const auto& element : header.elements) {
    const std::uint64_t most = context.options.max_triangles * (element.name == "vertex" ? 3 : 1);
    if ((element.name == "vertex" || element.name == "face") && element.count > most)
      return {too_many(context.name, element.name == "vertex" ? "vertices" : "faces", element.count, most)};
  }
  return {};
}

namespace {

/// Compares what the header promises with the bytes that follow it.
Diagnostics check_counts(const PlyHeader& header, std::uint64_t bytes_left, PlyData& data, const ReadContext& context) {
  if (auto wrong = check_ply_size(header, context); !wrong.empty()) return wrong;
  std::uint64_t least = 0;
  for (const auto& element : header.elements) {
    std::uint64_t size = 0;
    for (const auto& p : element.properties) size += header.ascii ? 2 : size_of(p.count_type == PlyType::none ? p.type : p.count_type);
    if (element.name == "vertex") {
      if (auto wrong = check_vertex_element(element, data, context); !wrong.empty()) return wrong;
    }
    if (element.name == "face") {
      data.face_white = white_of_element(element);
      data.has_face_textures = single_slots(element)[kTexture];
    }
    if (size > 0 && element.count > (bytes_left + 1) / size) least = bytes_left + 2;
    least += least > bytes_left ? 0 : size * element.count;
    if (least > bytes_left + 1) {  // the last word of a text may lack its blank
      return {truncated(context.name, fmt::format("promises {} of \"{}\", but has only {} bytes after its header", element.count,
                                                  element.name, bytes_left))};
    }
  }
  if (!data.has_vertices) return {make_error("mesh.bad-header", fmt::format("{}: has no vertices", context.name))};
  return {};
}

Diagnostic bad_value(const PlyBody& body, const PlyElement& element, std::uint64_t i, const ReadContext& context) {
  const auto where = fmt::format("{} {}", element.name, i);
  if (!body.wrong_word().empty()) return bad_number(context.name, where, body.wrong_word());
  return truncated(context.name, fmt::format("{} of {} is incomplete", where, element.count));
}

/// Reads entry `i` of an element into `entry`. In: the slot of each property.
Diagnostics read_entry(PlyBody& body, const PlyElement& element, const std::vector<Slot>& slots, std::uint64_t i, Entry& entry,
                       const ReadContext& context) {
  entry.indices.clear();
  entry.texcoords.clear();
  for (std::size_t k = 0; k < slots.size(); ++k) {
    const auto& property = element.properties[k];
    const Slot slot = slots[k];
    double value = 0, length = 0;
    if (property.count_type == PlyType::none) {
      if (!body.read(property.type, value)) return {bad_value(body, element, i, context)};
      if (slot < kSingleSlots) entry.values[slot] = value;
      continue;
    }
    if (!body.read(property.count_type, length)) return {bad_value(body, element, i, context)};
    if (!(length >= 0) || length > static_cast<double>(body.bytes_left()))
      return {truncated(context.name, fmt::format("{} {} has a list of {:g} entries", element.name, i, length))};
    for (double n = 0; n < length; ++n) {
      if (!body.read(property.type, value)) return {bad_value(body, element, i, context)};
      if (slot == kIndices) entry.indices.push_back(value);
      if (slot == kTexcoords) entry.texcoords.push_back(value);
    }
  }
  return {};
}

/// Colours may be any number in a hostile file; decode_colors clamps them.
mesh::LinearColor color_of(const Entry& entry) {
  const auto channel = [&](Slot slot) {
    return std::isfinite(entry.values[slot]) ? static_cast<float>(std::clamp(entry.values[slot], 0.0, 65535.0)) : 0.0f;
  };
  return {channel(kRed), channel(kGreen), channel(kBlue)};
}

Diagnostics add_vertex(const Entry& entry, std::uint64_t i, PlyData& data, const ReadContext& context) {
  const auto& v = entry.values;
  for (const auto slot : {kX, kY, kZ}) {
    if (!(std::abs(v[slot]) <= kMaxCoordinate)) return {not_finite(context.name, fmt::format("vertex {}", i))};
  }
  data.soup.positions.push_back({v[kX], v[kY], v[kZ]});
  if (data.vertex_white != 0) data.soup.vertex_color.push_back(color_of(entry));
  if (!data.has_vertex_uv) return {};
  if (!(std::abs(v[kU]) <= kMaxUv) || !(std::abs(v[kV]) <= kMaxUv)) return {not_finite(context.name, fmt::format("vertex {}", i))};
  data.vertex_uv.push_back({static_cast<float>(v[kU]), static_cast<float>(1 - v[kV])});
  return {};
}

Diagnostics add_face(const std::vector<double>& indices, const std::vector<double>& texcoords, std::uint64_t i, PlyData& data,
                     const ReadContext& context) {
  for (const double index : indices) {
    if (!(index >= 0) || index >= static_cast<double>(data.vertex_count) || index != std::floor(index)) {
      return {make_error("mesh.bad-index",
                         fmt::format("{}: face {} uses vertex {:g}, but there are only {}", context.name, i, index, data.vertex_count))};
    }
    data.soup.corners.push_back(static_cast<std::uint32_t>(index));
  }
  data.soup.end_face();
  if (data.soup.faces() > context.options.max_triangles)
    return {too_many(context.name, "faces", data.soup.faces(), context.options.max_triangles)};
  if (data.soup.corners.size() > 6 * context.options.max_triangles)
    return {too_many(context.name, "corners", data.soup.corners.size(), 6 * context.options.max_triangles)};
  if (texcoords.size() != 2 * indices.size()) data.every_face_has_uv = false;
  if (!data.every_face_has_uv) return {};
  for (std::size_t c = 0; c < indices.size(); ++c) {
    const double u = texcoords[2 * c], v = texcoords[2 * c + 1];
    if (!(std::abs(u) <= kMaxUv) || !(std::abs(v) <= kMaxUv)) return {not_finite(context.name, fmt::format("face {}", i))};
    data.soup.corner_uv.push_back({static_cast<float>(u), static_cast<float>(1 - v)});
  }
  return {};
}

/// A strip: every index makes a triangle with the two before it, turned over every second time; −1 begins anew.
Diagnostics add_strip(const std::vector<double>& strip, std::uint64_t i, PlyData& data, const ReadContext& context) {
  std::size_t start = 0;
  for (std::size_t k = 0; k < strip.size(); ++k) {
    if (strip[k] == -1) {
      start = k + 1;
    } else if (k >= start + 2) {
      const bool odd = (k - start) % 2 == 1;
      if (auto wrong = add_face({strip[k - 2], strip[odd ? k : k - 1], strip[odd ? k - 1 : k]}, {}, i, data, context); !wrong.empty())
        return wrong;
    }
  }
  return {};
}

Diagnostics read_elements(const PlyHeader& header, PlyBody& body, PlyData& data, const ReadContext& context) {
  Entry entry;
  for (const auto& element : header.elements) {
    if (element.properties.empty()) continue;  // takes no bytes, however many there are
    std::vector<Slot> slots;
    for (const auto& property : element.properties) slots.push_back(slot_of(element, property));
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (auto wrong = read_entry(body, element, slots, i, entry, context); !wrong.empty()) return wrong;
      Diagnostics wrong;
      if (element.name == "vertex") wrong = add_vertex(entry, i, data, context);
      if (element.name == "face") {
        wrong = add_face(entry.indices, entry.texcoords, i, data, context);
        if (data.face_white != 0) data.soup.face_color.push_back(color_of(entry));
        if (data.has_face_textures) data.face_texture.push_back(entry.values[kTexture]);
      }
      if (element.name == "tristrips") wrong = add_strip(entry.indices, i, data, context);
      if (!wrong.empty()) return wrong;
    }
  }
  return {};
}

/// Corners get their own uv, else those of their vertices.
void settle_uv(PlyData& data) {
  auto& soup = data.soup;
  if (data.every_face_has_uv && !soup.corner_uv.empty()) return;
  soup.corner_uv.clear();
  if (!data.has_vertex_uv) return;
  soup.corner_uv.reserve(soup.corners.size());
  for (const auto corner : soup.corners) soup.corner_uv.push_back(data.vertex_uv[corner]);
}

/// Strips have no colours or textures of their own.
void settle_colors(PlyData& data) {
  auto& soup = data.soup;
  if (soup.face_color.size() != soup.faces()) soup.face_color.clear();
  const float vertex_white = data.vertex_white > 0 ? data.vertex_white : white_of(soup.vertex_color);
  const float face_white = data.face_white > 0 ? data.face_white : white_of(soup.face_color);
  soup.vertex_color = decode_colors(std::move(soup.vertex_color), vertex_white);
  soup.face_color = decode_colors(std::move(soup.face_color), face_white);
}

/// One material for each texture of the header; one more for faces without.
void add_materials(const PlyHeader& header, PlyData& data, const ReadContext& context) {
  auto& soup = data.soup;
  if (header.textures.empty() || soup.corner_uv.empty()) return;
  TextureLoader textures(context);
  for (const auto& reference : header.textures) {
    mesh::Material material;
    material.color = {1, 1, 1};
    material.texture = textures.load(reference);
    soup.materials.push_back(material);
  }
  soup.textures = std::move(textures.textures);
  soup.warnings = std::move(textures.warnings);
  if (header.textures.size() < 2 || data.face_texture.size() != soup.faces()) return;
  soup.materials.push_back({});
  for (const double index : data.face_texture) {
    const bool known = index >= 0 && index < static_cast<double>(header.textures.size());
    soup.face_material.push_back(static_cast<std::uint32_t>(known ? index : static_cast<double>(header.textures.size())));
  }
}

}  // namespace

Result<PolygonSoup> read_ply(std::string_view bytes, const ReadContext& context) {
  if (bytes.substr(0, 3) == "\xef\xbb\xbf") bytes.remove_prefix(3);
  auto header = read_ply_header(bytes, context);
  if (!header) return std::move(header).error();
  PlyBody body(*header);
  PlyData data;
  if (auto wrong = check_counts(*header, body.bytes_left(), data, context); !wrong.empty()) return wrong;
  if (auto wrong = read_elements(*header, body, data, context); !wrong.empty()) return wrong;
  settle_uv(data);
  settle_colors(data);
  add_materials(*header, data, context);
  return std::move(data.soup);
}

}  // namespace orbc::mesh_io
