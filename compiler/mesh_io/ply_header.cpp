// PLY (Turk, "The PLY polygon file format", 1994): the header, and the numbers after it in text or binary of both byte orders.
#include "compiler/mesh_io/ply_header.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "compiler/mesh_io/errors.h"

namespace orbc::mesh_io {
namespace {

PlyType type_of(std::string_view word) {
  constexpr std::pair<std::string_view, PlyType> kTypes[] = {
      {"char", PlyType::i8},   {"int8", PlyType::i8},     {"uchar", PlyType::u8},   {"uint8", PlyType::u8},
      {"short", PlyType::i16}, {"int16", PlyType::i16},   {"ushort", PlyType::u16}, {"uint16", PlyType::u16},
      {"int", PlyType::i32},   {"int32", PlyType::i32},   {"uint", PlyType::u32},   {"uint32", PlyType::u32},
      {"float", PlyType::f32}, {"float32", PlyType::f32}, {"double", PlyType::f64}, {"float64", PlyType::f64}};
  for (const auto& [text, type] : kTypes) {
    if (text == word) return type;
  }
  return PlyType::none;
}

template <class T>
double number_at(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

double decode(PlyType type, const char* bytes) {
  switch (type) {
    case PlyType::none:
      return 0;
    case PlyType::i8:
      return number_at<std::int8_t>(bytes);
    case PlyType::u8:
      return number_at<std::uint8_t>(bytes);
    case PlyType::i16:
      return number_at<std::int16_t>(bytes);
    case PlyType::u16:
      return number_at<std::uint16_t>(bytes);
    case PlyType::i32:
      return number_at<std::int32_t>(bytes);
    case PlyType::u32:
      return number_at<std::uint32_t>(bytes);
    case PlyType::f32:
      return number_at<float>(bytes);
    case PlyType::f64:
      return number_at<double>(bytes);
  }
  return 0;
}

/// Takes the next line of the header: it ends in '\n', "\r\n" or, when `by_return`, '\r'.
std::string_view take_line(std::string_view& rest, bool by_return) {
  const auto end = rest.find(by_return ? '\r' : '\n');
  const auto line = rest.substr(0, end);
  rest.remove_prefix(end == rest.npos ? rest.size() : end + 1);
  return line;
}

/// Adds one line of the header. Makes: what is wrong with it, or "".
std::string add_line(Tokens& words, PlyHeader& header, bool& has_format) {
  const auto key = words.next_in_line();
  if (key == "format") {
    const auto word = words.next_in_line();
    header.ascii = word == "ascii";
    header.big_endian = word == "binary_big_endian";
    has_format = true;
    if (!header.ascii && !header.big_endian && word != "binary_little_endian") return "unknown format";
  } else if (key == "element") {
    PlyElement element;
    element.name = words.next_in_line();
    const auto count = to_integer(words.next_in_line());
    if (!count || *count < 0) return "an element without a count";
    element.count = static_cast<std::uint64_t>(*count);
    header.elements.push_back(element);
  } else if (key == "property") {
    PlyProperty property;
    auto word = words.next_in_line();
    if (word == "list") {
      property.count_type = type_of(words.next_in_line());
      if (property.count_type == PlyType::none || property.count_type >= PlyType::f32) return "a list needs an integer type for its length";
      word = words.next_in_line();
    }
    property.type = type_of(word);
    property.name = words.next_in_line();
    if (property.type == PlyType::none || property.name.empty()) return "a property without type or name";
    if (header.elements.empty()) return "a property before any element";
    header.elements.back().properties.push_back(property);
  } else if (key == "comment" && words.next_in_line() == "TextureFile") {
    header.textures.emplace_back(words.rest_of_line());
  }
  return {};
}

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::none:
      return 0;
    case PlyType::i8:
    case PlyType::u8:
      return 1;
    case PlyType::i16:
    case PlyType::u16:
      return 2;
    case PlyType::i32:
    case PlyType::u32:
    case PlyType::f32:
      return 4;
    case PlyType::f64:
      return 8;
  }
  return 0;
}

Result<PlyHeader> read_ply_header(std::string_view bytes, const ReadContext& context) {
  std::size_t line = 1;
  const auto bad = [&](const std::string& what) {
    return make_error("mesh.bad-header", fmt::format("{}: line {}: {}", context.name, line, what));
  };
  PlyHeader header;
  bool has_format = false;
  std::string_view rest = bytes;
  const bool by_return = rest.size() > 4 && rest[3] == '\r' && rest[4] != '\n';
  Tokens first(take_line(rest, by_return));
  const auto magic = first.rest_of_line();
  if (magic != "ply" && magic != "PLY") return bad("does not begin with \"ply\"");
  while (true) {
    if (rest.empty()) return truncated(context.name, "the header has no end_header");
    ++line;
    const auto text = take_line(rest, by_return);
    Tokens words(text);
    if (Tokens(text).next_in_line() == "end_header") break;
    if (const auto wrong = add_line(words, header, has_format); !wrong.empty()) return bad(wrong);
  }
  if (!has_format) return bad("the header has no format");
  header.body = rest;
  return header;
}

PlyBody::PlyBody(const PlyHeader& header)
    : ascii_(header.ascii), big_endian_(header.big_endian), tokens_(header.body), rest_(header.body) {}

std::uint64_t PlyBody::bytes_left() const { return ascii_ ? tokens_.rest().size() : rest_.size(); }

bool PlyBody::read_word(double& value) {
  const auto word = tokens_.next();
  if (word.empty()) return false;
  const auto number = to_number(word);
  if (!number) {
    wrong_word_ = word;
    return false;
  }
  value = *number;
  return true;
}

bool PlyBody::read_bytes(PlyType type, double& value) {
  const auto size = size_of(type);
  if (rest_.size() < size) return false;
  char bytes[8];
  std::memcpy(bytes, rest_.data(), size);
  rest_.remove_prefix(size);
  if (big_endian_) std::reverse(bytes, bytes + size);
  value = decode(type, bytes);
  return true;
}

}  // namespace orbc::mesh_io
