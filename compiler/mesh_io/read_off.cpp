// OFF (Geomview's "OFF" family): vertices and faces as text. The prefixes ST, C and N announce uv, colours and normals of the vertices;
// faces may end in a colour. Files of ModelNet have the first count glued to the keyword; others lack the keyword, which Geomview allows.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "compiler/mesh_io/colors.h"
#include "compiler/mesh_io/errors.h"
#include "compiler/mesh_io/readers.h"
#include "compiler/mesh_io/tokens.h"

namespace orbc::mesh_io {
namespace {

struct OffHeader {
  bool has_uv = false, has_colors = false, has_normals = false;
  std::uint64_t vertices = 0, faces = 0;
};

/// The keyword at the beginning, and what is glued to it.
struct Keyword {
  std::string prefix;            ///< of "STCN4n"
  std::string_view first_count;  ///< "" when it is a word of its own
};

std::optional<Keyword> parse_keyword(std::string_view word) {
  std::string upper(word);
  for (auto& c : upper) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  const auto at = upper.find("OFF");
  if (at == upper.npos) return to_integer(word) ? std::optional<Keyword>({"", word}) : std::nullopt;
  const bool exact = word.substr(at, 3) == "OFF";
  const std::string prefix = exact ? std::string(word.substr(0, at)) : upper.substr(0, at);
  const auto rest = word.substr(at + 3);
  if (prefix.find_first_not_of("STCN4n") != prefix.npos || (!rest.empty() && !to_integer(rest))) return {};
  return Keyword{prefix, rest};
}

/// The dimension that follows "nOFF" must be 3.
bool is_of_dimension_3(const Keyword& keyword, Tokens& tokens) {
  if (keyword.prefix.find('4') != keyword.prefix.npos) return false;
  return keyword.prefix.find('n') == keyword.prefix.npos || to_integer(tokens.next(true)) == 3;
}

Result<OffHeader> read_header(Tokens& tokens, std::size_t bytes, const ReadContext& context) {
  const auto keyword = parse_keyword(tokens.next(true));
  if (!keyword) return make_error("mesh.bad-header", fmt::format("{}: does not begin with OFF", context.name));
  if (!is_of_dimension_3(*keyword, tokens))
    return make_error("mesh.unsupported", fmt::format("{}: OFF of another dimension than 3", context.name));
  std::array<std::uint64_t, 2> counts{};  // of vertices and faces
  std::array<std::size_t, 2> lines{};
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const auto word = k == 0 && !keyword->first_count.empty() ? keyword->first_count : tokens.next(true);
    if (k == 0 && word == "BINARY")
      return make_error("mesh.unsupported", fmt::format("{}: binary OFF", context.name), "export it as text, or as PLY");
    if (word.empty()) return truncated(context.name, "the counts are missing");
    const auto count = to_integer(word);
    if (!count || *count < 0) return bad_number(context.name, "counts", word);
    counts[k] = static_cast<std::uint64_t>(*count);
    lines[k] = tokens.line();
  }
  // The count of edges is not needed, and some files leave it out. It has a line of its own where the others have.
  if (tokens.next_in_line().empty() && lines[0] != lines[1]) (void)tokens.next(true);
  const auto max_triangles = context.options.max_triangles;
  // A vertex takes at least six bytes ("0 0 0\n"), a face two; the last line may lack its end.
  if (counts[0] > bytes / 6 + 1 || counts[1] > bytes / 2 + 1)
    return truncated(context.name, fmt::format("promises {} vertices and {} faces in {} bytes", counts[0], counts[1], bytes));
  if (counts[0] > 3 * max_triangles) return too_many(context.name, "vertices", counts[0], 3 * max_triangles);
  if (counts[1] > max_triangles) return too_many(context.name, "faces", counts[1], max_triangles);
  const auto has = [&](char letter) { return keyword->prefix.find(letter) != std::string::npos; };
  return OffHeader{has('T'), has('C'), has('N'), counts[0], counts[1]};
}

/// The numbers on the rest of the line, up to a comment; at most 16.
std::vector<double> rest_of_numbers(Tokens& tokens) {
  constexpr std::size_t kMaxNumbers = 16;
  std::vector<double> numbers;
  Tokens rest(tokens.rest_of_line());
  for (auto word = rest.next_in_line(); !word.empty() && numbers.size() < kMaxNumbers; word = rest.next_in_line()) {
    const auto value = to_number(word);
    if (!value || !(std::abs(*value) <= kMaxUv)) break;
    numbers.push_back(*value);
  }
  return numbers;
}

mesh::LinearColor color_at(const std::vector<double>& numbers, std::size_t at) {
  return {static_cast<float>(numbers[at]), static_cast<float>(numbers[at + 1]), static_cast<float>(numbers[at + 2])};
}

/// What stands on the lines, not yet sorted out.
struct OffData {
  PolygonSoup soup;
  std::vector<std::array<float, 2>> uv;
  std::vector<std::uint32_t> colored_faces;    ///< which faces have a colour
  std::vector<mesh::LinearColor> face_colors;  ///< of those
  bool has_indexed_colors = false;
};

/// The order of the numbers behind x, y and z: normal, colour, uv.
void add_vertex_attributes(const std::vector<double>& numbers, const OffHeader& header, OffData& data) {
  const std::size_t first = header.has_normals ? 3 : 0,
                    last = numbers.size() - std::min<std::size_t>(numbers.size(), header.has_uv ? 2 : 0);
  if (header.has_colors && first + 3 <= last) data.soup.vertex_color.push_back(color_at(numbers, first));
  if (header.has_uv && numbers.size() >= first + 2)
    data.uv.push_back({static_cast<float>(numbers[last]), static_cast<float>(1 - numbers[last + 1])});
}

Diagnostics read_vertex(Tokens& tokens, std::uint64_t v, const OffHeader& header, OffData& data, const ReadContext& context) {
  const auto line = tokens.line();
  const auto where = [&] { return fmt::format("line {}: vertex {}", line, v); };
  std::array<double, 3> p{};
  for (auto& coordinate : p) {
    const auto word = tokens.next(true);
    if (word.empty()) return {truncated(context.name, where() + " is incomplete")};
    const auto value = to_number(word);
    if (!value) return {bad_number(context.name, where(), word)};
    if (!(std::abs(*value) <= kMaxCoordinate)) return {not_finite(context.name, where())};
    coordinate = *value;
  }
  data.soup.positions.push_back({p[0], p[1], p[2]});
  if (header.has_colors || header.has_uv) add_vertex_attributes(rest_of_numbers(tokens), header, data);
  else tokens.rest_of_line();
  return {};
}

Diagnostics read_face(Tokens& tokens, std::uint64_t f, const OffHeader& header, OffData& data, const ReadContext& context) {
  auto word = tokens.next(true);
  if (word.empty()) return {truncated(context.name, fmt::format("{} faces are promised, {} are there", header.faces, f))};
  const auto corners = to_integer(word);
  if (!corners || *corners < 0) return {bad_number(context.name, fmt::format("line {}: face {}", tokens.line(), f), word)};
  auto& soup = data.soup;
  for (std::int64_t c = 0; c < *corners; ++c) {
    word = tokens.next(true);
    if (word.empty()) return {truncated(context.name, fmt::format("face {} is incomplete", f))};
    const auto index = to_integer(word);
    if (!index) return {bad_number(context.name, fmt::format("line {}: face {}", tokens.line(), f), word)};
    if (*index < 0 || static_cast<std::uint64_t>(*index) >= header.vertices) {
      return {make_error("mesh.bad-index", fmt::format("{}: line {}: face {} uses vertex {}, but there are only {}", context.name,
                                                       tokens.line(), f, *index, header.vertices))};
    }
    soup.corners.push_back(static_cast<std::uint32_t>(*index));
  }
  soup.end_face();
  if (soup.corners.size() > 6 * context.options.max_triangles)
    return {too_many(context.name, "corners", soup.corners.size(), 6 * context.options.max_triangles)};
  const auto numbers = rest_of_numbers(tokens);
  if (numbers.size() >= 3) {
    data.colored_faces.push_back(static_cast<std::uint32_t>(f));
    data.face_colors.push_back(color_at(numbers, 0));
  }
  data.has_indexed_colors = data.has_indexed_colors || numbers.size() == 1;
  return {};
}

/// Keeps colours and uv that every vertex has, and the colours of faces. Faces without one get the plain colour.
void settle_attributes(OffData& data, const ReadContext& context) {
  auto& soup = data.soup;
  if (soup.vertex_color.size() != soup.positions.size()) soup.vertex_color.clear();
  soup.vertex_color = decode_colors(std::move(soup.vertex_color), white_of(soup.vertex_color));
  if (!soup.positions.empty() && data.uv.size() == soup.positions.size()) {
    for (const auto corner : soup.corners) soup.corner_uv.push_back(data.uv[corner]);
  }
  if (data.has_indexed_colors) {
    soup.warnings.push_back(
        make_warning("mesh.ignored", context.name + ": colours of faces by index are left out", "export it with red, green and blue"));
  }
  if (data.face_colors.empty()) return;
  const mesh::Material plain;
  soup.face_color.assign(soup.faces(),
                         {static_cast<float>(plain.color[0]), static_cast<float>(plain.color[1]), static_cast<float>(plain.color[2])});
  const auto colors = decode_colors(data.face_colors, white_of(data.face_colors));
  for (std::size_t k = 0; k < colors.size(); ++k) soup.face_color[data.colored_faces[k]] = colors[k];
}

}  // namespace

Result<PolygonSoup> read_off(std::string_view bytes, const ReadContext& context) {
  const DecodedText decoded = decode_text(bytes);
  Tokens tokens(decoded.text());
  const auto header = read_header(tokens, decoded.text().size(), context);
  if (!header) return header.error();
  tokens.rest_of_line();
  OffData data;
  for (std::uint64_t v = 0; v < header->vertices; ++v) {
    if (auto wrong = read_vertex(tokens, v, *header, data, context); !wrong.empty()) return wrong;
  }
  for (std::uint64_t f = 0; f < header->faces; ++f) {
    if (auto wrong = read_face(tokens, f, *header, data, context); !wrong.empty()) return wrong;
  }
  settle_attributes(data, context);
  return std::move(data.soup);
}

}  // namespace orbc::mesh_io
