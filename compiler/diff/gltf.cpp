// glTF 2.0 (Khronos specification 2.0.1, §3.6 and §4). Where things lie in buffers is nobody's business; what accessors say is compared.
// Every offset, length and index is checked here before a byte is read.
#include <fmt/format.h>

#include <cstring>
#include <map>
#include <vector>

#include "compiler/diff/json.h"

namespace orbc::diff {
namespace {

using Json = nlohmann::json;

/// A file that has been taken apart.
struct Model {
  const Source* source = nullptr;
  Json tree;
  std::string_view chunk;  ///< of a GLB: its binary part
  std::vector<std::string> buffers;
};

struct Problem {
  Diagnostic diagnostic;
};

[[noreturn]] void refuse(const Model& model, const std::string& what) { throw Problem{bad_file(model.source->name, what)}; }

/// A count, offset or index: absent is `otherwise`.
std::uint64_t whole(const Model& model, const Json& object, const char* key, std::uint64_t otherwise) {
  const auto at = object.find(key);
  if (at == object.end()) return otherwise;
  if (!at->is_number_unsigned()) refuse(model, fmt::format("`{}` is no whole number", key));
  return at->get<std::uint64_t>();
}

const Json& member(const Model& model, const char* list, std::uint64_t index) {
  const auto at = model.tree.find(list);
  if (at == model.tree.end() || !at->is_array() || index >= at->size() || !(*at)[index].is_object())
    refuse(model, fmt::format("there is no {}[{}]", list, index));
  return (*at)[index];
}

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, 4);  // little-endian, as all machines that orbc runs on
  return word;
}

/// Splits a GLB into its JSON and its binary chunk.
std::string_view open_glb(Model& model) {
  const std::string_view bytes = model.source->bytes;
  if (bytes.size() < 20 || bytes.substr(0, 4) != "glTF") refuse(model, "this is no GLB");
  if (word_at(bytes, 4) != 2) refuse(model, "only version 2 of glTF is read");
  if (word_at(bytes, 8) != bytes.size()) refuse(model, "the file is cut short, or longer than it says");
  const std::uint64_t length = word_at(bytes, 12);
  if (bytes.substr(16, 4) != "JSON" || 20 + length > bytes.size()) refuse(model, "its first chunk is not JSON, or is cut short");
  const std::uint64_t next = 20 + length;
  if (next + 8 <= bytes.size()) {
    const std::uint64_t size = word_at(bytes, next);
    if (next + 8 + size > bytes.size()) refuse(model, "its binary chunk is cut short");
    model.chunk = bytes.substr(next + 8, size);
  }
  return bytes.substr(20, length);
}

std::string bytes_of_uri(const Model& model, const std::string& uri) {
  if (uri.rfind("data:", 0) != 0) {
    auto bytes = read_beside(*model.source, uri);
    if (!bytes) throw Problem{bytes.error().front()};
    return *std::move(bytes);
  }
  const std::size_t comma = uri.find(";base64,");
  auto bytes = comma == std::string::npos ? std::nullopt : decode_base64(std::string_view(uri).substr(comma + 8));
  if (!bytes) refuse(model, "a data URI is not base64");
  return *std::move(bytes);
}

Model open_model(Form form, const Source& source) {
  Model model;
  model.source = &source;
  auto tree = parse_json(form == Form::glb ? open_glb(model) : std::string_view(source.bytes), source.name);
  if (!tree) throw Problem{tree.error().front()};
  model.tree = *std::move(tree);
  if (!model.tree.is_object()) refuse(model, "its JSON is no object");
  const auto buffers = model.tree.find("buffers");
  for (std::size_t i = 0; buffers != model.tree.end() && i < buffers->size(); ++i) {
    const Json& buffer = member(model, "buffers", i);
    const auto uri = buffer.find("uri");
    if (uri == buffer.end()) model.buffers.push_back(i == 0 ? std::string(model.chunk) : std::string());
    else if (uri->is_string()) model.buffers.push_back(bytes_of_uri(model, uri->get_ref<const std::string&>()));
    else refuse(model, "the uri of a buffer is no text");
    if (whole(model, buffer, "byteLength", 0) > model.buffers.back().size()) refuse(model, fmt::format("buffers[{}] is cut short", i));
  }
  return model;
}

std::string_view view(const Model& model, std::uint64_t index) {
  const Json& of = member(model, "bufferViews", index);
  const std::uint64_t buffer = whole(model, of, "buffer", ~std::uint64_t{0}), offset = whole(model, of, "byteOffset", 0),
                      length = whole(model, of, "byteLength", 0);
  if (buffer >= model.buffers.size()) refuse(model, fmt::format("bufferViews[{}] names no buffer", index));
  const std::string& bytes = model.buffers[buffer];
  if (offset > bytes.size() || length > bytes.size() - offset) refuse(model, fmt::format("bufferViews[{}] leaves its buffer", index));
  return std::string_view(bytes).substr(offset, length);
}

/// What an accessor reads: `count` elements of `components` each, `stride` bytes apart. In range.
struct Column {
  std::string_view bytes;
  std::uint64_t count = 0, stride = 0, components = 0, size = 0;
  std::uint64_t type = 0;
  bool normalized = false;
};

Column column(const Model& model, std::uint64_t index) {
  static const std::map<std::string, std::uint64_t> kComponents = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                                                                   {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
  static const std::map<std::uint64_t, std::uint64_t> kSizes = {{5120, 1}, {5121, 1}, {5122, 2}, {5123, 2}, {5125, 4}, {5126, 4}};
  const Json& accessor = member(model, "accessors", index);
  const auto wrong = [&](const char* what) { refuse(model, fmt::format("accessors[{}] {}", index, what)); };
  if (accessor.contains("sparse")) wrong("is sparse, which is not read");
  const auto type = accessor.find("type");
  if (type == accessor.end() || !type->is_string() || !kComponents.count(type->get<std::string>())) wrong("has no known type");
  Column column;
  column.components = kComponents.at(type->get<std::string>());
  column.type = whole(model, accessor, "componentType", 0);
  if (!kSizes.count(column.type)) wrong("has no known componentType");
  column.size = kSizes.at(column.type);
  column.normalized = accessor.value("normalized", Json(false)) == Json(true);
  column.count = whole(model, accessor, "count", 0);
  const std::uint64_t of = whole(model, accessor, "bufferView", ~std::uint64_t{0});
  if (of == ~std::uint64_t{0} || column.count == 0) return column.count = 0, column;  // all zeros
  column.bytes = view(model, of);
  column.stride = whole(model, member(model, "bufferViews", of), "byteStride", column.components * column.size);
  const std::uint64_t offset = whole(model, accessor, "byteOffset", 0), element = column.components * column.size;
  if (column.stride < element || column.stride > 4096) wrong("has a wrong stride");
  if (offset > column.bytes.size() || element > column.bytes.size() - offset ||
      column.count - 1 > (column.bytes.size() - offset - element) / column.stride)
    wrong("leaves its buffer view");
  column.bytes.remove_prefix(offset);
  return column;
}

template <class T>
double value_of(std::string_view bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof(T));
  return static_cast<double>(value);
}

double component(const Column& column, std::uint64_t element, std::uint64_t c) {
  const std::string_view at = column.bytes.substr(element * column.stride + c * column.size, column.size);
  switch (column.type) {
    case 5120:
      return value_of<std::int8_t>(at) / (column.normalized ? 127 : 1);
    case 5121:
      return value_of<std::uint8_t>(at) / (column.normalized ? 255 : 1);
    case 5122:
      return value_of<std::int16_t>(at) / (column.normalized ? 32767 : 1);
    case 5123:
      return value_of<std::uint16_t>(at) / (column.normalized ? 65535 : 1);
    case 5125:
      return value_of<std::uint32_t>(at);
    default:
      return value_of<float>(at);
  }
}

void compare_columns(const Column& a, const Column& b, std::uint64_t index, const Limits& limits, Finding& finding) {
  const bool measured = a.type == 5126 || a.normalized;
  const Limits exact;
  for (std::uint64_t element = 0; element < a.count; ++element) {
    const std::uint64_t from = element * a.stride, other = element * b.stride, size = a.components * a.size;
    if (std::memcmp(a.bytes.data() + from, b.bytes.data() + other, size) == 0) {
      finding.numbers += a.components;
      continue;
    }
    for (std::uint64_t c = 0; c < a.components; ++c) {
      const double x = component(a, element, c), y = component(b, element, c);
      (void)take_numbers(x, y, measured ? limits : exact, finding, [&] {
        const std::string at = fmt::format("accessor {}, element {}, component {}", index, element, c);
        return Difference{at, at, fmt::format("{} against {}", x, y)};
      });
    }
  }
}

/// What in the tree says where things lie, or what another comparison looks at.
bool is_layout(std::string_view path) {
  const auto ends = [&](std::string_view end) { return path.size() >= end.size() && path.substr(path.size() - end.size()) == end; };
  if (path == "$.buffers" || path == "$.bufferViews") return true;
  if (path.substr(0, 12) == "$.accessors[") return ends("].bufferView") || ends("].byteOffset");
  return path.substr(0, 9) == "$.images[" && (ends("].bufferView") || ends("].uri"));
}

/// The encoded picture; `held` keeps bytes that come from elsewhere.
EncodedPicture picture(const Model& model, std::uint64_t index, std::string& held) {
  const Json& image = member(model, "images", index);
  const std::string name = fmt::format("{}: images[{}]", model.source->name, index);
  const std::uint64_t of = whole(model, image, "bufferView", ~std::uint64_t{0});
  if (of != ~std::uint64_t{0}) return {name, view(model, of)};
  const auto uri = image.find("uri");
  if (uri == image.end() || !uri->is_string()) refuse(model, fmt::format("images[{}] names no picture", index));
  held = bytes_of_uri(model, uri->get_ref<const std::string&>());
  return {name, held};
}

std::size_t count_of(const Model& model, const char* list) {
  const auto at = model.tree.find(list);
  return at == model.tree.end() || !at->is_array() ? 0 : at->size();
}

}  // namespace

Diagnostics compare_gltf(Form form, const Source& a, const Source& b, const Limits& limits, Finding& finding) {
  try {
    const Model left = open_model(form, a), right = open_model(form, b);
    compare_trees(left.tree, right.tree, {a, b, is_layout}, limits, finding);
    if (!finding.same_structure) return {};
    for (std::uint64_t i = 0; i < count_of(left, "accessors"); ++i) {
      const Column x = column(left, i), y = column(right, i);
      if (x.count != y.count) {
        const std::string at = fmt::format("$.accessors[{}].bufferView", i);
        return finding.differ_in_structure({at, at, "only one of the files has numbers there"}), Diagnostics{};
      }
      compare_columns(x, y, i, limits, finding);
    }
    for (std::uint64_t i = 0; i < count_of(left, "images"); ++i) {
      std::string held_left, held_right;
      const EncodedPicture x = picture(left, i, held_left), y = picture(right, i, held_right);
      if (auto errors = compare_pictures(x, y, limits, finding); !errors.empty()) return errors;
    }
  } catch (const Problem& problem) {
    return {problem.diagnostic};
  }
  return {};
}

}  // namespace orbc::diff
