// Wavefront's MTL (Wavefront "Advanced Visualizer" manual, appendix B; Paul Bourke's page).
#include "compiler/mesh_io/read_mtl.h"

#include <algorithm>
#include <cmath>

#include "compiler/mesh_io/errors.h"
#include "compiler/mesh_io/tokens.h"

namespace orbc::mesh_io {
namespace {

std::string lower_case(std::string_view word) {
  std::string text(word);
  for (auto& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

/// How many arguments an option of a map may have, at most; all but those of -s, -o and -t have a fixed number.
int max_arguments(const std::string& option) {
  if (option == "-s" || option == "-o" || option == "-t") return 3;
  if (option == "-mm") return 2;
  for (const char* known : {"-blendu", "-blendv", "-clamp", "-cc", "-bm", "-boost", "-texres", "-imfchan", "-type"})
    if (option == known) return 1;
  return -1;
}

struct MapStatement {
  std::string file;
  std::array<double, 2> scale{1, 1}, offset{0, 0};
};

/// Options come before the file's name, which may have blanks.
MapStatement read_map(std::string_view rest) {
  MapStatement map;
  Tokens tokens(rest);
  while (true) {
    Tokens ahead = tokens;
    const std::string option = lower_case(ahead.next_in_line());
    const int arguments = max_arguments(option);
    if (arguments < 0) break;
    for (int k = 0; k < arguments; ++k) {
      Tokens before = ahead;
      const auto value = to_number(ahead.next_in_line());
      // -s, -o and -t take one to three numbers, the other options one word that need not be a number.
      if (!value && arguments == 3) {
        ahead = before;
        break;
      }
      if (!value || k > 1 || !(std::abs(*value) <= kMaxUv)) continue;
      if (option == "-s") map.scale[static_cast<std::size_t>(k)] = *value;
      if (option == "-o") map.offset[static_cast<std::size_t>(k)] = *value;
    }
    tokens = ahead;
  }
  map.file = std::string(tokens.rest_of_line());
  if (map.file.size() > 1 && map.file.front() == '"' && map.file.back() == '"') map.file = map.file.substr(1, map.file.size() - 2);
  return map;
}

void read_color(Tokens& tokens, std::array<double, 3>& color) {
  const auto first = to_number(tokens.next_in_line());
  if (!first) return;  // "spectral" and "xyz" curves
  color.fill(std::clamp(*first, 0.0, 1.0));
  for (std::size_t k = 1; k < 3; ++k) {
    if (const auto value = to_number(tokens.next_in_line())) color[k] = std::clamp(*value, 0.0, 1.0);
  }
}

}  // namespace

void read_mtl(std::string_view bytes, MtlLibrary& library) {
  const DecodedText decoded = decode_text(bytes);
  Tokens tokens(decoded.text());
  MtlMaterial* material = nullptr;
  while (!tokens.at_end()) {
    const std::string key = lower_case(tokens.next_in_line());
    if (key == "newmtl") {
      material = &library[std::string(tokens.rest_of_line())];
      *material = {};
      continue;
    }
    if (key == "kd" && material) read_color(tokens, material->color);
    if (key == "map_kd" && material) {
      const MapStatement map = read_map(tokens.rest_of_line());
      material->texture = map.file;
      material->uv_scale = map.scale;
      material->uv_offset = map.offset;
      continue;
    }
    tokens.rest_of_line();
  }
}

}  // namespace orbc::mesh_io
