// A sieve for PLY (Turk's "The PLY polygon file format", 1994): ascii, binary of both byte orders, any properties and elements.
// What comes out is a little-endian binary PLY of x y z (u v) and vertex_indices. Per-corner "texcoord" lists, as MeshLab writes
// them, are unknown to OpenMesh and travel beside the text; triangle strips (Stanford) become triangles.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "compiler/mesh/sieve.h"
#include "compiler/mesh/tokens.h"

namespace orbc::mesh {
namespace {

enum class Type { none, i8, u8, i16, u16, i32, u32, f32, f64 };

struct Property {
  std::string name;
  Type type = Type::none, count_type = Type::none;  // count_type == none: a scalar
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  bool ascii = false, big_endian = false;
  std::vector<Element> elements;
  std::string texture;
};

Type type_of(std::string_view word) {
  constexpr std::pair<std::string_view, Type> kTypes[] = {
      {"char", Type::i8},   {"int8", Type::i8},     {"uchar", Type::u8},   {"uint8", Type::u8},
      {"short", Type::i16}, {"int16", Type::i16},   {"ushort", Type::u16}, {"uint16", Type::u16},
      {"int", Type::i32},   {"int32", Type::i32},   {"uint", Type::u32},   {"uint32", Type::u32},
      {"float", Type::f32}, {"float32", Type::f32}, {"double", Type::f64}, {"float64", Type::f64}};
  for (const auto& [text, type] : kTypes) {
    if (text == word) return type;
  }
  return Type::none;
}

std::size_t size_of(Type type) {
  switch (type) {
    case Type::none:
      return 0;
    case Type::i8:
    case Type::u8:
      return 1;
    case Type::i16:
    case Type::u16:
      return 2;
    case Type::i32:
    case Type::u32:
    case Type::f32:
      return 4;
    case Type::f64:
      return 8;
  }
  return 0;
}

Result<Header> read_header(Tokens& tokens, const std::string& name) {
  const auto bad = [&](const std::string& what) {
    return make_error("mesh.bad-header", fmt::format("{}: line {}: {}", name, tokens.line(), what));
  };
  Header header;
  const auto magic = tokens.rest_of_line();
  if (magic != "ply" && magic != "PLY") return bad("does not begin with \"ply\"");
  bool format = false;
  while (true) {
    if (tokens.at_end()) return truncated(name, "the header has no end_header");
    const auto key = tokens.next_in_line();
    if (key == "end_header") break;
    if (key == "format") {
      const auto word = tokens.next_in_line();
      header.ascii = word == "ascii";
      header.big_endian = word == "binary_big_endian";
      if (!header.ascii && !header.big_endian && word != "binary_little_endian") return bad("unknown format");
      format = true;
    } else if (key == "element") {
      Element element;
      element.name = tokens.next_in_line();
      const auto count = to_integer(tokens.next_in_line());
      if (!count || *count < 0) return bad("an element without a count");
      element.count = static_cast<std::uint64_t>(*count);
      header.elements.push_back(element);
    } else if (key == "property") {
      Property property;
      auto word = tokens.next_in_line();
      if (word == "list") {
        property.count_type = type_of(tokens.next_in_line());
        if (property.count_type == Type::none || property.count_type >= Type::f32)
          return bad("a list needs an integer type for its length");
        word = tokens.next_in_line();
      }
      property.type = type_of(word);
      property.name = tokens.next_in_line();
      if (property.type == Type::none || property.name.empty()) return bad("a property without type or name");
      if (header.elements.empty()) return bad("a property before any element");
      header.elements.back().properties.push_back(property);
    } else if (key == "comment" && tokens.next_in_line() == "TextureFile" && header.texture.empty()) {
      header.texture = tokens.rest_of_line();
      continue;
    }
    tokens.rest_of_line();
  }
  tokens.rest_of_line();
  if (!format) return bad("the header has no format");
  return header;
}

/// Reads one number after the other from the body, whatever its encoding.
class Body {
 public:
  Body(const Header& header, std::string_view rest) : ascii_(header.ascii), big_(header.big_endian), tokens_(rest), rest_(rest) {}

  /// False at the end of the file, or when a word is no number.
  bool read(Type type, double& value) { return ascii_ ? read_word(value) : read_bytes(type, value); }
  [[nodiscard]] std::uint64_t bytes_left() const { return ascii_ ? tokens_.rest().size() : rest_.size(); }
  [[nodiscard]] std::string_view wrong_word() const { return wrong_; }

 private:
  bool read_word(double& value) {
    const auto word = tokens_.next();
    if (word.empty()) return false;
    const auto number = to_number(word);
    if (!number) return wrong_ = word, false;
    value = *number;
    return true;
  }
  template <class T>
  static double as(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
  }
  bool read_bytes(Type type, double& value) {
    const auto size = size_of(type);
    if (rest_.size() < size) return false;
    char bytes[8];
    std::memcpy(bytes, rest_.data(), size);
    rest_.remove_prefix(size);
    if (big_) std::reverse(bytes, bytes + size);
    switch (type) {
      case Type::none:
        break;
      case Type::i8:
        value = as<std::int8_t>(bytes);
        break;
      case Type::u8:
        value = as<std::uint8_t>(bytes);
        break;
      case Type::i16:
        value = as<std::int16_t>(bytes);
        break;
      case Type::u16:
        value = as<std::uint16_t>(bytes);
        break;
      case Type::i32:
        value = as<std::int32_t>(bytes);
        break;
      case Type::u32:
        value = as<std::uint32_t>(bytes);
        break;
      case Type::f32:
        value = as<float>(bytes);
        break;
      case Type::f64:
        value = as<double>(bytes);
        break;
    }
    return true;
  }
  bool ascii_, big_;
  Tokens tokens_;
  std::string_view rest_, wrong_;
};

template <class T>
void put(std::string& out, T value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}

/// What a property means to us: a slot of `values`, a list of corners, or nothing.
enum Slot { kX, kY, kZ, kU, kV, kIndices, kTexcoords, kNothing };

Slot slot_of(const Element& element, const Property& property) {
  const bool list = property.count_type != Type::none;
  const auto& n = property.name;
  if (element.name == "vertex" && !list) {
    if (n == "x") return kX;
    if (n == "y") return kY;
    if (n == "z") return kZ;
    if (n == "u" || n == "s" || n == "texture_u" || n == "texture_s") return kU;
    if (n == "v" || n == "t" || n == "texture_v" || n == "texture_t") return kV;
  }
  if ((element.name == "face" || element.name == "tristrips") && list) {
    if (n == "vertex_indices" || n == "vertex_index") return kIndices;
    if (n == "texcoord" && element.name == "face") return kTexcoords;
  }
  return kNothing;
}

class PlySieve {
 public:
  PlySieve(const Header& header, std::string_view body, const std::string& name, const LoadOptions& options)
      : header_(header), body_(header, body), name_(name), options_(options) {}

  Result<Sieved> run() {
    if (auto wrong = check_counts(); !wrong.empty()) return wrong;
    for (const auto& element : header_.elements) {
      if (element.properties.empty()) continue;  // takes no bytes, however many
      std::vector<Slot> slots;
      for (const auto& property : element.properties) slots.push_back(slot_of(element, property));
      for (std::uint64_t i = 0; i < element.count; ++i) {
        if (auto wrong = read_one(element, slots, i); !wrong.empty()) return wrong;
      }
    }
    Sieved sieved;
    sieved.binary = true;
    sieved.has_uv = vertex_uv_;
    sieved.text = fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n{}"
        "element face {}\nproperty list int uint vertex_indices\nend_header\n",
        vertex_count_, vertex_uv_ ? "property float u\nproperty float v\n" : "", face_count_);
    sieved.text += vertices_ + faces_;
    if (corner_uv_complete_ && !corner_uv_.empty()) sieved.corner_uv = std::move(corner_uv_);
    return sieved;
  }

 private:
  Diagnostics check_counts() {
    std::uint64_t least = 0;
    for (const auto& element : header_.elements) {
      std::uint64_t size = 0;
      for (const auto& p : element.properties) size += header_.ascii ? 2 : size_of(p.count_type == Type::none ? p.type : p.count_type);
      if (element.name == "vertex") {
        if (vertex_element_) return {make_error("mesh.bad-header", fmt::format("{}: two elements \"vertex\"", name_))};
        vertex_element_ = true;
        vertex_count_ = element.count;
        if (element.count > 3 * options_.max_triangles) return {too_many(name_, "vertices", element.count, 3 * options_.max_triangles)};
        bool has[5] = {};
        for (const auto& p : element.properties) {
          if (const auto slot = slot_of(element, p); slot <= kV) has[slot] = true;
        }
        if (!has[kX] || !has[kY] || !has[kZ])
          return {make_error("mesh.bad-header", fmt::format("{}: the vertices have no x, y, z", name_))};
        vertex_uv_ = has[kU] && has[kV];
      }
      if (element.name == "face" && element.count > options_.max_triangles) {
        return {too_many(name_, "faces", element.count, options_.max_triangles)};
      }
      if (size > 0 && element.count > (body_.bytes_left() + 1) / size) least = body_.bytes_left() + 2;
      least += least > body_.bytes_left() ? 0 : size * element.count;
      if (least > body_.bytes_left() + 1) {  // the last word of an ascii file may lack its blank
        return {truncated(name_, fmt::format("promises {} of \"{}\", but has only {} bytes after its header", element.count, element.name,
                                             body_.bytes_left()))};
      }
    }
    if (!vertex_element_) return {make_error("mesh.bad-header", fmt::format("{}: has no vertices", name_))};
    return {};
  }

  Diagnostic bad_value(const Element& element, std::uint64_t i) {
    const auto where = fmt::format("{} {}", element.name, i);
    if (!body_.wrong_word().empty()) return bad_number(name_, where, body_.wrong_word());
    return truncated(name_, fmt::format("{} of {} is incomplete", where, element.count));
  }

  Diagnostics read_one(const Element& element, const std::vector<Slot>& slots, std::uint64_t i) {
    double values[5] = {};
    list_.clear();
    uv_.clear();
    for (std::size_t k = 0; k < slots.size(); ++k) {
      const auto& property = element.properties[k];
      double value = 0;
      if (property.count_type == Type::none) {
        if (!body_.read(property.type, value)) return {bad_value(element, i)};
        if (slots[k] <= kV) values[slots[k]] = value;
        continue;
      }
      double length = 0;
      if (!body_.read(property.count_type, length)) return {bad_value(element, i)};
      if (!(length >= 0) || length > static_cast<double>(body_.bytes_left())) {
        return {truncated(name_, fmt::format("{} {} has a list of {:g} entries", element.name, i, length))};
      }
      for (double n = 0; n < length; ++n) {
        if (!body_.read(property.type, value)) return {bad_value(element, i)};
        if (slots[k] == kIndices) list_.push_back(value);
        if (slots[k] == kTexcoords) uv_.push_back(value);
      }
    }
    if (element.name == "vertex") return vertex(values, i);
    if (element.name == "face") return face(list_, i);
    if (element.name == "tristrips") return strips(i);
    return {};
  }

  Diagnostics vertex(const double (&values)[5], std::uint64_t i) {
    for (int k = 0; k < (vertex_uv_ ? 5 : 3); ++k) {
      if (!(std::abs(values[k]) <= kLargestCoordinate)) return {not_finite(name_, fmt::format("vertex {}", i))};
      put(vertices_, static_cast<float>(values[k]));
    }
    return {};
  }

  Diagnostics face(const std::vector<double>& list, std::uint64_t i) {
    for (const double index : list) {
      if (!(index >= 0) || index >= static_cast<double>(vertex_count_) || index != std::floor(index)) {
        return {make_error("mesh.bad-index",
                           fmt::format("{}: face {} uses vertex {:g}, but there are only {}", name_, i, index, vertex_count_))};
      }
    }
    put(faces_, static_cast<std::uint32_t>(list.size()));
    for (const double index : list) put(faces_, static_cast<std::uint32_t>(index));
    if (++face_count_ > options_.max_triangles) return {too_many(name_, "faces", face_count_, options_.max_triangles)};
    if (uv_.size() == 2 * list.size()) {
      for (std::size_t c = 0; c < list.size(); ++c) {
        if (!(std::abs(uv_[2 * c]) <= 1e6) || !(std::abs(uv_[2 * c + 1]) <= 1e6)) return {not_finite(name_, fmt::format("face {}", i))};
        corner_uv_.push_back({static_cast<float>(uv_[2 * c]), static_cast<float>(1 - uv_[2 * c + 1])});
      }
    } else {
      corner_uv_complete_ = false;
    }
    return {};
  }

  Diagnostics strips(std::uint64_t i) {
    std::vector<double> strip = std::move(list_), triangle(3);
    std::size_t start = 0;
    for (std::size_t k = 0; k < strip.size(); ++k) {
      if (strip[k] == -1) {
        start = k + 1;
      } else if (k >= start + 2) {
        const bool odd = (k - start) % 2 == 1;
        triangle = {strip[k - 2], strip[odd ? k : k - 1], strip[odd ? k - 1 : k]};
        if (auto wrong = face(triangle, i); !wrong.empty()) return wrong;
      }
    }
    return {};
  }

  const Header& header_;
  Body body_;
  const std::string& name_;
  const LoadOptions& options_;
  bool vertex_element_ = false, vertex_uv_ = false, corner_uv_complete_ = true;
  std::uint64_t vertex_count_ = 0, face_count_ = 0;
  std::string vertices_, faces_;
  std::vector<double> list_, uv_;
  std::vector<std::array<float, 2>> corner_uv_;
};

}  // namespace

Result<Sieved> sieve_ply(std::string_view bytes, const std::string& name, const std::string& folder, const LoadOptions& options) {
  Tokens tokens(bytes);
  auto header = read_header(tokens, name);
  if (!header) return std::move(header).error();
  auto sieved = PlySieve(*header, tokens.rest(), name, options).run();
  if (!sieved || header->texture.empty() || (!sieved->has_uv && sieved->corner_uv.empty())) return sieved;
  add_texture(header->texture, name, folder, options, {1, 1, 1}, *sieved);
  return sieved;
}

}  // namespace orbc::mesh
