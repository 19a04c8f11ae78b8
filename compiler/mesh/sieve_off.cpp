// Sieves for OFF and STL. OFF: Geomview's "OFF" family (ST, C, N prefixes; here the extra numbers are read over).
// STL: 80 bytes, a count, 50 bytes a triangle; or text of "vertex x y z" lines.
#include <fmt/core.h>
#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "compiler/mesh/sieve.h"
#include "compiler/mesh/tokens.h"

namespace orbc::mesh {
namespace {

/// Three coordinates from the text, as a word OpenMesh reads exactly.
Result<bool> copy_coordinates(Tokens& tokens, bool comments, const std::string& name, const std::string& where, std::string& text) {
  for (int k = 0; k < 3; ++k) {
    const auto word = tokens.next(comments);
    if (word.empty()) return truncated(name, where + " is incomplete");
    const auto value = to_number(word);
    if (!value) return bad_number(name, where, word);
    if (!(std::abs(*value) <= kLargestCoordinate)) return not_finite(name, where);
    fmt::format_to(std::back_inserter(text), "{:.9g}{}", *value, k < 2 ? ' ' : '\n');
  }
  return true;
}

}  // namespace

Result<Sieved> sieve_off(std::string_view bytes, const std::string& name, const LoadOptions& options) {
  Tokens tokens(bytes);
  auto word = tokens.next(true);
  if (word.size() < 3 || word.substr(word.size() - 3) != "OFF" || word.find_first_not_of("STCNO4nF") != word.npos) {
    return make_error("mesh.bad-header", fmt::format("{}: does not begin with OFF", name));
  }
  const auto prefix = word.substr(0, word.size() - 3);
  if (prefix.find_first_of("4n") != prefix.npos)
    return make_error("mesh.unsupported", fmt::format("{}: OFF of another dimension than 3", name));
  std::uint64_t counts[2] = {0, 0};
  for (int k = 0; k < 3; ++k) {
    word = tokens.next(true);
    if (k == 0 && word == "BINARY")
      return make_error("mesh.unsupported", fmt::format("{}: binary OFF", name), "export it as text, or as PLY");
    if (word.empty()) return truncated(name, "the counts are missing");
    const auto count = to_integer(word);
    if (!count || *count < 0) return bad_number(name, "counts", word);
    if (k < 2) counts[k] = static_cast<std::uint64_t>(*count);
  }
  // A vertex takes at least six bytes ("0 0 0\n"), a face eight; the last line may lack its end.
  if (counts[0] > bytes.size() / 6 + 1 || counts[1] > bytes.size() / 2 + 1) {
    return truncated(name, fmt::format("promises {} vertices and {} faces in {} bytes", counts[0], counts[1], bytes.size()));
  }
  if (counts[0] > 3 * options.max_triangles) return too_many(name, "vertices", counts[0], 3 * options.max_triangles);
  if (counts[1] > options.max_triangles) return too_many(name, "faces", counts[1], options.max_triangles);
  tokens.rest_of_line();
  Sieved sieved;
  auto& text = sieved.text;
  text = fmt::format("OFF\n{} {} 0\n", counts[0], counts[1]);
  for (std::uint64_t v = 0; v < counts[0]; ++v) {
    auto done = copy_coordinates(tokens, true, name, fmt::format("line {}: vertex {}", tokens.line(), v), text);
    if (!done) return std::move(done).error();
    tokens.rest_of_line();
  }
  std::vector<std::int64_t> face;
  for (std::uint64_t f = 0; f < counts[1]; ++f) {
    word = tokens.next(true);
    if (word.empty()) return truncated(name, fmt::format("{} faces are promised, {} are there", counts[1], f));
    const auto corners = to_integer(word);
    if (!corners || *corners < 0) return bad_number(name, fmt::format("line {}: face {}", tokens.line(), f), word);
    face.clear();
    for (std::int64_t c = 0; c < *corners; ++c) {
      word = tokens.next(true);
      if (word.empty()) return truncated(name, fmt::format("face {} is incomplete", f));
      const auto index = to_integer(word);
      if (!index) return bad_number(name, fmt::format("line {}: face {}", tokens.line(), f), word);
      if (*index < 0 || static_cast<std::uint64_t>(*index) >= counts[0]) {
        return make_error("mesh.bad-index", fmt::format("{}: line {}: face {} uses vertex {}, but there are only {}", name, tokens.line(),
                                                        f, *index, counts[0]));
      }
      face.push_back(*index);
    }
    tokens.rest_of_line();
    // Faces of fewer than three corners stay as they are: the soup counts them; OpenMesh's reader wants at least one number.
    fmt::format_to(std::back_inserter(text), "{}", face.size());
    for (const auto index : face) fmt::format_to(std::back_inserter(text), " {}", index);
    text += '\n';
  }
  return sieved;
}

namespace {

Result<Sieved> sieve_binary_stl(std::string_view bytes, std::uint32_t count, const std::string& name, const LoadOptions& options) {
  if (count > options.max_triangles) return too_many(name, "triangles", count, options.max_triangles);
  for (std::uint32_t t = 0; t < count; ++t) {
    float corners[9];
    std::memcpy(corners, bytes.data() + 84 + std::size_t{50} * t + 12, sizeof corners);
    for (const float value : corners) {
      if (!(std::abs(static_cast<double>(value)) <= kLargestCoordinate)) return not_finite(name, fmt::format("triangle {}", t));
    }
  }
  Sieved sieved;
  sieved.binary = true;
  sieved.text = bytes.substr(0, 84 + std::size_t{50} * count);
  return sieved;
}

Result<Sieved> sieve_text_stl(std::string_view bytes, const std::string& name, const LoadOptions& options) {
  Tokens tokens(bytes);
  Sieved sieved;
  auto& text = sieved.text;
  text = "solid mesh\n";
  std::uint64_t corners = 0, corner_of_facet = 0;
  bool ended = false;
  while (!tokens.at_end()) {
    const auto line = tokens.line();
    const auto word = tokens.next();
    if (word.empty()) break;
    if (word == "vertex") {
      if (corner_of_facet++ == 0) text += "facet normal 0 0 1\nouter loop\n";
      if (corner_of_facet > 3)
        return make_error("mesh.bad-header", fmt::format("{}: line {}: a facet with more than three vertices", name, line));
      text += "vertex ";
      auto done = copy_coordinates(tokens, false, name, fmt::format("line {}", tokens.line()), text);
      if (!done) return std::move(done).error();
      if (corner_of_facet == 3) text += "endloop\nendfacet\n";
      if (++corners > 3 * options.max_triangles) return too_many(name, "vertices", corners, 3 * options.max_triangles);
    } else if (word == "endfacet" || word == "facet") {
      if (corner_of_facet != 0 && corner_of_facet != 3) {
        return make_error("mesh.bad-header", fmt::format("{}: line {}: a facet with {} vertices", name, tokens.line(), corner_of_facet));
      }
      corner_of_facet = 0;
      tokens.rest_of_line();
    } else if (word == "endsolid") {
      ended = true;
      tokens.rest_of_line();
    } else if (word == "solid" || word == "outer" || word == "endloop") {
      ended = ended && word != "solid";
      tokens.rest_of_line();
    } else {
      return make_error("mesh.bad-header", fmt::format("{}: line {}: what is this? STL has facet, outer loop, vertex, endloop, endfacet",
                                                       name, tokens.line()));
    }
  }
  if (!ended) return truncated(name, "\"endsolid\" is missing at the end");
  if (corner_of_facet % 3 != 0) return truncated(name, "the last facet is incomplete");
  text += "endsolid mesh\n";
  return sieved;
}

}  // namespace

Result<Sieved> sieve_stl(std::string_view bytes, const std::string& name, const LoadOptions& options) {
  // Binary files may begin with "solid" too: the size decides, then the word.
  std::uint32_t count = 0;
  if (bytes.size() >= 84) std::memcpy(&count, bytes.data() + 80, 4);
  const std::uint64_t expected = 84 + std::uint64_t{50} * count;
  if (bytes.size() >= 84 && bytes.size() == expected) return sieve_binary_stl(bytes, count, name, options);
  if (bytes.substr(0, 5) == "solid") return sieve_text_stl(bytes, name, options);
  if (bytes.size() < 84) return truncated(name, fmt::format("{} bytes are neither a binary nor a text STL file", bytes.size()));
  if (bytes.size() < expected) {
    return truncated(name, fmt::format("promises {} triangles, which take {} bytes, but has {}", count, expected, bytes.size()));
  }
  return sieve_binary_stl(bytes, count, name, options);  // some programs add bytes at the end
}

}  // namespace orbc::mesh
