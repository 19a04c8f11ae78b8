// OFF (Geomview's "OFF" family): vertices and faces as text. The prefixes ST, C, N, 4 and n announce further numbers.
#include <fmt/core.h>

#include <array>
#include <cmath>

#include "compiler/mesh_io/errors.h"
#include "compiler/mesh_io/readers.h"
#include "compiler/mesh_io/tokens.h"

namespace orbc::mesh_io {
namespace {

struct OffHeader {
  std::uint64_t vertices = 0, faces = 0;
};

Result<OffHeader> read_header(Tokens& tokens, std::size_t bytes, const ReadContext& context) {
  auto word = tokens.next(true);
  if (word.size() < 3 || word.substr(word.size() - 3) != "OFF" || word.find_first_not_of("STCNO4nF") != word.npos)
    return make_error("mesh.bad-header", fmt::format("{}: does not begin with OFF", context.name));
  const auto prefix = word.substr(0, word.size() - 3);
  if (prefix.find_first_of("4n") != prefix.npos)
    return make_error("mesh.unsupported", fmt::format("{}: OFF of another dimension than 3", context.name));
  std::array<std::uint64_t, 3> counts{};  // of vertices, faces and edges
  for (std::size_t k = 0; k < 3; ++k) {
    word = tokens.next(true);
    if (k == 0 && word == "BINARY")
      return make_error("mesh.unsupported", fmt::format("{}: binary OFF", context.name), "export it as text, or as PLY");
    if (word.empty()) return truncated(context.name, "the counts are missing");
    const auto count = to_integer(word);
    if (!count || *count < 0) return bad_number(context.name, "counts", word);
    counts[k] = static_cast<std::uint64_t>(*count);
  }
  const auto max_triangles = context.options.max_triangles;
  // A vertex takes at least six bytes ("0 0 0\n"), a face two; the last line may lack its end.
  if (counts[0] > bytes / 6 + 1 || counts[1] > bytes / 2 + 1)
    return truncated(context.name, fmt::format("promises {} vertices and {} faces in {} bytes", counts[0], counts[1], bytes));
  if (counts[0] > 3 * max_triangles) return too_many(context.name, "vertices", counts[0], 3 * max_triangles);
  if (counts[1] > max_triangles) return too_many(context.name, "faces", counts[1], max_triangles);
  return OffHeader{counts[0], counts[1]};
}

Diagnostics read_vertex(Tokens& tokens, std::uint64_t v, PolygonSoup& soup, const ReadContext& context) {
  const auto where = fmt::format("line {}: vertex {}", tokens.line(), v);
  std::array<double, 3> p{};
  for (auto& coordinate : p) {
    const auto word = tokens.next(true);
    if (word.empty()) return {truncated(context.name, where + " is incomplete")};
    const auto value = to_number(word);
    if (!value) return {bad_number(context.name, where, word)};
    if (!(std::abs(*value) <= kMaxCoordinate)) return {not_finite(context.name, where)};
    coordinate = *value;
  }
  soup.positions.push_back({p[0], p[1], p[2]});
  return {};
}

Diagnostics read_face(Tokens& tokens, std::uint64_t f, const OffHeader& header, PolygonSoup& soup, const ReadContext& context) {
  auto word = tokens.next(true);
  if (word.empty()) return {truncated(context.name, fmt::format("{} faces are promised, {} are there", header.faces, f))};
  const auto corners = to_integer(word);
  if (!corners || *corners < 0) return {bad_number(context.name, fmt::format("line {}: face {}", tokens.line(), f), word)};
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
  return {};
}

}  // namespace

Result<PolygonSoup> read_off(std::string_view bytes, const ReadContext& context) {
  const DecodedText decoded = decode_text(bytes);
  Tokens tokens(decoded.text());
  const auto header = read_header(tokens, bytes.size(), context);
  if (!header) return header.error();
  tokens.rest_of_line();
  PolygonSoup soup;
  for (std::uint64_t v = 0; v < header->vertices; ++v) {
    if (auto wrong = read_vertex(tokens, v, soup, context); !wrong.empty()) return wrong;
    tokens.rest_of_line();
  }
  for (std::uint64_t f = 0; f < header->faces; ++f) {
    if (auto wrong = read_face(tokens, f, *header, soup, context); !wrong.empty()) return wrong;
    tokens.rest_of_line();
  }
  return soup;
}

}  // namespace orbc::mesh_io
