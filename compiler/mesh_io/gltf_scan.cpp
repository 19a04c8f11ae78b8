// A look at the structure of a glTF file that needs no JSON tree: only brackets, commas and the keys of the outermost object.
#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/mesh_io/errors.h"
#include "compiler/mesh_io/read_gltf.h"

namespace orbc::mesh_io {
namespace {

// Generous for any real file; tinygltf needs up to about 1.5 kB for an object and 0.3 kB for a value, so the worst is below 1.5 GB.
constexpr std::uint64_t kMaxDepth = 64, kMaxObjects = 300'000, kMaxValues = 3'000'000;

/// Extensions that a file may require: they are read, or what they say makes no difference here.
bool is_known_extension(std::string_view name) {
  if (name.substr(0, 14) == "KHR_materials_") return true;
  for (const std::string_view known : {"KHR_mesh_quantization", "KHR_texture_transform", "KHR_lights_punctual", "EXT_mesh_gpu_instancing",
                                       "KHR_node_visibility", "EXT_texture_webp", "KHR_xmp_json_ld", "KHR_animation_pointer"})
    if (name == known) return true;
  return false;
}

std::string hint_for_extension(std::string_view name) {
  if (name == "KHR_draco_mesh_compression" || name == "EXT_meshopt_compression" || name == "KHR_meshopt_compression")
    return "export it without compression";
  if (name.find("texture") != name.npos) return "export its pictures as PNG or JPEG";
  return "export it without this extension";
}

struct JsonScan {
  std::uint64_t depth = 0, deepest = 0, objects = 0, values = 0, buffers = 0;
  std::vector<std::string_view> required;  ///< the strings of the list extensionsRequired
  bool escaped_key = false;
  bool open_string = false;
};

JsonScan scan_json(std::string_view json) {
  JsonScan scan;
  std::string_view key;  // the last string seen at depth 1
  bool in_buffers = false, in_required = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (c == '"') {
      const auto begin = ++i;
      bool escaped = false;
      while (i < json.size() && json[i] != '"') {
        if (json[i] == '\\') escaped = true, ++i;
        ++i;
      }
      if (i >= json.size()) scan.open_string = true;
      if (scan.depth == 2 && in_required) scan.required.push_back(json.substr(begin, std::min(i, json.size()) - begin));
      if (scan.depth == 1) {
        key = json.substr(begin, std::min(i, json.size()) - begin);
        scan.escaped_key = scan.escaped_key || escaped;
      }
    } else if (c == '{' || c == '[') {
      scan.objects += c == '{';
      if (scan.depth == 1) in_buffers = key == "buffers";
      if (scan.depth == 1) in_required = key == "extensionsRequired" && c == '[';
      if (scan.depth == 2 && in_buffers && c == '{') ++scan.buffers;
      scan.deepest = std::max(scan.deepest, ++scan.depth);
    } else if (c == '}' || c == ']') {
      scan.depth -= scan.depth > 0;
    } else if (c == ',') {
      ++scan.values;
    }
  }
  return scan;
}

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (int k = 3; k >= 0; --k) value = value << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(k)]);
  return value;
}

}  // namespace

Diagnostics scan_gltf(std::string_view bytes, bool binary, const ReadContext& context) {
  const auto bad = [&](const std::string& what) {
    return Diagnostics{make_error("mesh.bad-gltf", fmt::format("{}: {}", context.name, what))};
  };
  std::string_view json = bytes;
  std::uint64_t chunk = 0;
  if (binary) {
    if (bytes.substr(0, 4) != "glTF") return bad("does not begin with \"glTF\"");
    if (bytes.size() < 20) return {truncated(context.name, "the file ends in its header")};
    if (word_at(bytes, 4) != 2) return bad(fmt::format("is glTF {}; only 2.0 is read", word_at(bytes, 4)));
    const std::uint64_t total = word_at(bytes, 8), length = word_at(bytes, 12);
    if (total > bytes.size()) return {truncated(context.name, fmt::format("promises {} bytes, but has {}", total, bytes.size()))};
    if (length + 20 > total) return {truncated(context.name, fmt::format("promises {} bytes of JSON in {} bytes", length, total))};
    json = bytes.substr(20, length);
    if (total >= length + 28) {
      chunk = word_at(bytes, 20 + length);
      if (length + 28 + chunk > total) return {truncated(context.name, fmt::format("promises {} bytes of data in {} bytes", chunk, total))};
    }
  }
  const auto scan = scan_json(json);
  if (scan.open_string || scan.depth != 0) return {truncated(context.name, "the JSON ends before its last bracket is closed")};
  if (scan.escaped_key) return bad("a key of the outermost object is written with escapes");
  if (scan.deepest > kMaxDepth) return bad(fmt::format("brackets {} deep; at most {} are read", scan.deepest, kMaxDepth));
  if (scan.objects > kMaxObjects) return {too_many(context.name, "JSON objects", scan.objects, kMaxObjects)};
  if (scan.values > kMaxValues) return {too_many(context.name, "JSON values", scan.values, kMaxValues)};
  for (const auto name : scan.required) {
    if (!is_known_extension(name))
      return {make_error("mesh.unsupported", fmt::format("{}: needs the glTF extension {}", context.name, quotable(name)),
                         hint_for_extension(name))};
  }
  // Every buffer without a uri is a copy of the one chunk.
  if (scan.buffers * chunk > 2 * context.options.max_file_bytes)
    return {too_many(context.name, "buffers of the whole file's size", scan.buffers, 1)};
  return {};
}

}  // namespace orbc::mesh_io
