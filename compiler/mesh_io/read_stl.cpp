// STL: 80 bytes, a count, 50 bytes a triangle; or text of "vertex x y z" lines.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "compiler/mesh/weld.h"
#include "compiler/mesh_io/colors.h"
#include "compiler/mesh_io/errors.h"
#include "compiler/mesh_io/readers.h"
#include "compiler/mesh_io/tokens.h"

namespace orbc::mesh_io {
namespace {

constexpr std::size_t kHeaderBytes = 84, kTriangleBytes = 50, kNormalBytes = 12, kColorAt = 48;

Diagnostic repaired(const ReadContext& context, const std::string& what) {
  return make_warning("mesh.repaired", fmt::format("{}: {}", context.name, what), "check that nothing is missing, or export it again");
}

/// The colour of a triangle in 15 bits, five for each channel, sRGB-encoded.
mesh::LinearColor color_of_bits(unsigned bits, bool red_is_low) {
  const auto low = static_cast<float>(bits & 31), middle = static_cast<float>(bits >> 5 & 31), high = static_cast<float>(bits >> 10 & 31);
  return red_is_low ? mesh::LinearColor{low, middle, high} : mesh::LinearColor{high, middle, low};
}

/// Two programs put colours into the two bytes that the format leaves unused. Materialise Magics announces that by "COLOR=" and the colour
/// of the rest in the header, and marks triangles that have the latter by the top bit; VisCAM marks those that have one of their own.
void add_colors(std::string_view bytes, std::uint32_t count, PolygonSoup& soup) {
  const auto at = bytes.substr(0, kHeaderBytes - 4).find("COLOR=");
  const bool is_magics = at != bytes.npos && at + 9 <= kHeaderBytes - 4;
  constexpr float kFiveBits = 31;
  mesh::LinearColor rest{0.906f * kFiveBits, 0.906f * kFiveBits, 0.906f * kFiveBits};
  for (std::size_t k = 0; k < 3 && is_magics; ++k)
    rest[k] = static_cast<float>(static_cast<unsigned char>(bytes[at + 6 + k])) / 255 * kFiveBits;
  bool any = is_magics;
  std::vector<mesh::LinearColor> colors;
  for (std::uint32_t t = 0; t < count; ++t) {
    const char* word = bytes.data() + kHeaderBytes + kTriangleBytes * t + kColorAt;
    const unsigned bits = static_cast<unsigned char>(word[0]) | static_cast<unsigned>(static_cast<unsigned char>(word[1])) << 8;
    const bool has_own = (bits >> 15 == 1) != is_magics;
    colors.push_back(has_own ? color_of_bits(bits, is_magics) : rest);
    any = any || has_own;
  }
  if (any) soup.face_color = decode_colors(std::move(colors), kFiveBits);
}

/// Corners at the same position become one vertex; vertices are in the order of their first corner.
void weld_corners(PolygonSoup& soup) {
  const auto first = mesh::weld_positions(soup.positions);
  std::vector<std::uint32_t> vertex(first.size());
  std::uint32_t count = 0;
  for (std::size_t c = 0; c < first.size(); ++c) {
    if (first[c] == c) {
      soup.positions[count] = soup.positions[c];
      vertex[c] = count++;
    } else {
      vertex[c] = vertex[first[c]];
    }
    soup.corners.push_back(vertex[c]);
    if (c % 3 == 2) soup.end_face();
  }
  soup.positions.resize(count);
}

Result<PolygonSoup> read_binary(std::string_view bytes, std::uint32_t count, const ReadContext& context) {
  if (count > context.options.max_triangles) return too_many(context.name, "triangles", count, context.options.max_triangles);
  PolygonSoup soup;
  soup.positions.reserve(std::size_t{3} * count);
  for (std::uint32_t t = 0; t < count; ++t) {
    float values[9];
    std::memcpy(values, bytes.data() + kHeaderBytes + kTriangleBytes * t + kNormalBytes, sizeof values);
    for (std::size_t k = 0; k < 9; k += 3) {
      const double x = values[k], y = values[k + 1], z = values[k + 2];
      if (!(std::abs(x) <= kMaxCoordinate && std::abs(y) <= kMaxCoordinate && std::abs(z) <= kMaxCoordinate))
        return not_finite(context.name, fmt::format("triangle {}", t));
      soup.positions.push_back({x, y, z});
    }
  }
  weld_corners(soup);
  add_colors(bytes, count, soup);
  return soup;
}

Result<geometry::Vector3> read_position(Tokens& tokens, const ReadContext& context) {
  std::array<double, 3> p{};
  const auto where = fmt::format("line {}", tokens.line());
  for (auto& coordinate : p) {
    const auto word = tokens.next();
    if (word.empty()) return truncated(context.name, where + " is incomplete");
    const auto value = to_number(word);
    if (!value) return bad_number(context.name, where, word);
    if (!(std::abs(*value) <= kMaxCoordinate)) return not_finite(context.name, where);
    coordinate = *value;
  }
  return geometry::Vector3{p[0], p[1], p[2]};
}

Result<PolygonSoup> read_text(std::string_view text, const ReadContext& context) {
  const auto bad = [&](std::size_t line, const std::string& what) {
    return make_error("mesh.bad-header", fmt::format("{}: line {}: {}", context.name, line, what));
  };
  Tokens tokens(text);
  PolygonSoup soup;
  std::uint64_t corner_of_facet = 0;
  bool ended = false;
  while (!tokens.at_end()) {
    const auto line = tokens.line();
    const auto word = lower_case(tokens.next());
    if (word.empty()) break;
    if (word == "vertex") {
      if (++corner_of_facet > 3) return bad(line, "a facet with more than three vertices");
      auto position = read_position(tokens, context);
      if (!position) return std::move(position).error();
      soup.positions.push_back(*position);
      if (soup.positions.size() > 3 * context.options.max_triangles)
        return too_many(context.name, "vertices", soup.positions.size(), 3 * context.options.max_triangles);
      continue;
    }
    if (word == "endfacet" || word == "facet") {
      if (corner_of_facet != 0 && corner_of_facet != 3) return bad(tokens.line(), fmt::format("a facet with {} vertices", corner_of_facet));
      corner_of_facet = 0;
    } else if (word == "endsolid") {
      ended = true;
    } else if (word == "solid" || word == "outer" || word == "endloop") {
      ended = ended && word != "solid";
    } else {
      return bad(tokens.line(), "what is this? STL has facet, outer loop, vertex, endloop, endfacet");
    }
    tokens.rest_of_line();
  }
  if (corner_of_facet % 3 != 0) return truncated(context.name, "the last facet is incomplete");
  if (!ended) soup.warnings.push_back(repaired(context, "\"endsolid\" is missing at the end"));
  weld_corners(soup);
  return soup;
}

}  // namespace

Diagnostics check_stl_size(std::string_view beginning, std::uint64_t file_bytes, const ReadContext& context) {
  std::uint32_t count = 0;
  if (beginning.size() < kHeaderBytes) return {};
  std::memcpy(&count, beginning.data() + kHeaderBytes - 4, 4);
  const std::uint64_t expected = kHeaderBytes + std::uint64_t{kTriangleBytes} * count;
  if (file_bytes != expected || count <= context.options.max_triangles) return {};
  return {too_many(context.name, "triangles", count, context.options.max_triangles)};
}

Result<PolygonSoup> read_stl(std::string_view bytes, const ReadContext& context) {
  // Binary files may begin with "solid" too: the size decides, then the word.
  std::uint32_t count = 0;
  if (bytes.size() >= kHeaderBytes) std::memcpy(&count, bytes.data() + kHeaderBytes - 4, 4);
  const std::uint64_t expected = kHeaderBytes + std::uint64_t{kTriangleBytes} * count;
  if (bytes.size() >= kHeaderBytes && bytes.size() == expected) return read_binary(bytes, count, context);
  const DecodedText decoded = decode_text(bytes);
  if (lower_case(Tokens(decoded.text()).next()) == "solid") return read_text(decoded.text(), context);
  // Programs that write while they work do not come back to fill in the count.
  const std::uint64_t whole = bytes.size() < kHeaderBytes ? 0 : (bytes.size() - kHeaderBytes) / kTriangleBytes;
  if ((count == 0 || count == 0xffffffff) && whole > 0 && bytes.size() == kHeaderBytes + whole * kTriangleBytes) {
    auto soup = read_binary(bytes, static_cast<std::uint32_t>(std::min<std::uint64_t>(whole, 0xfffffffe)), context);
    if (soup) soup->warnings.push_back(repaired(context, fmt::format("its header promises {} triangles, its size holds {}", count, whole)));
    return soup;
  }
  if (bytes.size() < kHeaderBytes)
    return truncated(context.name, fmt::format("{} bytes are neither a binary nor a text STL file", bytes.size()));
  if (bytes.size() < expected)
    return truncated(context.name, fmt::format("promises {} triangles, which take {} bytes, but has {}", count, expected, bytes.size()));
  return read_binary(bytes, count, context);  // some programs add bytes at the end
}

}  // namespace orbc::mesh_io
