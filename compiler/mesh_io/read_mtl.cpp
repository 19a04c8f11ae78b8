// Wavefront's MTL (Wavefront "Advanced Visualizer" manual, appendix B; its extension for physically based materials by Exocortex).
#include "compiler/mesh_io/read_mtl.h"

#include <algorithm>
#include <cmath>

#include "compiler/mesh_io/errors.h"
#include "compiler/mesh_io/tokens.h"
#include "compiler/mesh_io/transparency.h"

namespace orbc::mesh_io {
namespace {

/// How many arguments an option of a map may have, at most; all but -s, -o and -t have a fixed number. −1: no option.
int max_arguments(const std::string& option) {
  if (option == "-s" || option == "-o" || option == "-t") return 3;
  if (option == "-mm") return 2;
  for (const char* known : {"-blendu", "-blendv", "-clamp", "-cc", "-bm", "-boost", "-texres", "-imfchan", "-type"})
    if (option == known) return 1;
  return -1;
}

/// Reads the arguments of one option and moves `tokens` behind them.
void read_option(const std::string& option, int arguments, Tokens& tokens, MtlMap& map) {
  for (int k = 0; k < arguments; ++k) {
    const Tokens before = tokens;
    const auto word = tokens.next_in_line();
    const auto value = to_number(word);
    // -s, -o and -t take one to three numbers, the other options one word that need not be a number.
    if (!value && arguments == 3) {
      tokens = before;
      return;
    }
    if (option == "-clamp") map.is_clamped = word == "on";
    if (!value || k > 1 || !(std::abs(*value) <= kMaxUv)) continue;
    if (option == "-s") map.scale[static_cast<std::size_t>(k)] = *value;
    if (option == "-o") map.offset[static_cast<std::size_t>(k)] = *value;
  }
}

/// Options come before the file's name, which may have blanks.
MtlMap read_map(std::string_view rest) {
  MtlMap map;
  Tokens tokens(rest);
  while (true) {
    Tokens ahead = tokens;
    const std::string option = lower_case(ahead.next_in_line());
    const int arguments = max_arguments(option);
    if (arguments < 0) break;
    read_option(option, arguments, ahead, map);
    tokens = ahead;
  }
  map.file = std::string(tokens.rest_of_line());
  if (map.file.size() > 1 && map.file.front() == '"' && map.file.back() == '"') map.file = map.file.substr(1, map.file.size() - 2);
  return map;
}

/// One number stands for all three channels. Curves ("spectral", "xyz") are not read.
std::array<double, 3> read_color(Tokens& tokens, const std::array<double, 3>& otherwise) {
  const auto first = to_number(tokens.next_in_line());
  if (!first) return otherwise;
  std::array<double, 3> color{};
  color.fill(*first);
  for (std::size_t k = 1; k < 3; ++k) {
    if (const auto value = to_number(tokens.next_in_line())) color[k] = *value;
  }
  for (double& channel : color) channel = std::clamp(channel, 0.0, 1e6);
  return color;
}

double read_number(Tokens& tokens, double otherwise) {
  auto word = tokens.next_in_line();
  if (word == "-halo") word = tokens.next_in_line();
  const auto value = to_number(word);
  return value && std::abs(*value) <= 1e6 ? *value : otherwise;
}

bool is_ignored(const std::string& key) {
  for (const char* known : {"bump", "map_bump", "norm", "map_norm", "disp", "map_disp", "decal", "refl", "map_refl", "map_ks", "map_ns",
                            "map_ke", "map_pr", "map_pm", "map_ps", "map_tr"})
    if (key == known) return true;
  return false;
}

void read_statement(const std::string& key, Tokens& tokens, MtlMaterial& material, MtlLibrary& library) {
  if (key == "kd") {
    material.color = read_color(tokens, material.color);
    for (double& channel : material.color) channel = std::min(channel, 1.0);
  } else if (key == "ke") {
    material.emission = read_color(tokens, material.emission);
  } else if (key == "d") {
    material.opacity = std::clamp(read_number(tokens, 1), 0.0, 1.0);
  } else if (key == "tr") {
    // Some programs mean opacity by it: "Tr 1" alone is taken for opaque.
    const double transparency = std::clamp(read_number(tokens, 0), 0.0, 1.0);
    if (!material.opacity && transparency < 1) material.opacity = 1 - transparency;
  } else if (key == "ni") {
    material.index = std::clamp(read_number(tokens, 1), 1.0, 10.0);
  } else if (key == "illum") {
    material.illumination = static_cast<int>(read_number(tokens, 2));
  } else if (key == "pm") {
    material.metallic = read_number(tokens, 0);
  } else if (key == "pr") {
    material.roughness = std::clamp(read_number(tokens, 0.3), 0.0, 1.0);
  } else if (key == "map_kd") {
    material.texture = read_map(tokens.rest_of_line());
    return;
  } else if (key == "map_d") {
    material.opacity_map = read_map(tokens.rest_of_line());
    return;
  } else if (is_ignored(key)) {
    library.ignored.insert(key);
  }
  tokens.rest_of_line();
}

/// The texture, with the mask as its alpha. Makes: an index, or −1.
int load_texture(const MtlMaterial& material, TextureLoader& textures) {
  const int colors = material.texture.file.empty() ? -1 : textures.load(material.texture.file);
  if (material.opacity_map.file.empty()) return colors;
  const int mask = textures.load(material.opacity_map.file);
  if (mask < 0) return colors;
  const image::Image* picture = colors >= 0 ? &textures.textures[static_cast<std::size_t>(colors)] : nullptr;
  return textures.add(with_opacity_mask(picture, textures.textures[static_cast<std::size_t>(mask)]));
}

bool is_transparent_illumination(int illumination) {
  return illumination == 4 || illumination == 6 || illumination == 7 || illumination == 9;
}

}  // namespace

void read_mtl(std::string_view bytes, MtlLibrary& library) {
  const DecodedText decoded = decode_text(bytes);
  Tokens tokens(decoded.text());
  MtlMaterial* material = nullptr;
  while (!tokens.at_end()) {
    const std::string key = lower_case(tokens.next_in_line());
    if (key == "newmtl") {
      material = &library.materials[std::string(tokens.rest_of_line())];
      *material = {};
    } else if (material) {
      read_statement(key, tokens, *material, library);
    } else {
      tokens.rest_of_line();
    }
  }
}

ConvertedMaterial convert(const MtlMaterial& material, TextureLoader& textures) {
  ConvertedMaterial made;
  made.material.texture = load_texture(material, textures);
  // Programs write any Kd beside a picture, often black; the picture alone counts.
  const bool has_colors = made.material.texture >= 0 && !material.texture.file.empty();
  made.material.color = has_colors ? std::array<double, 3>{1, 1, 1} : material.color;
  if (material.texture.is_clamped) made.wrap = {Wrap::clamp, Wrap::clamp};
  const double brightest = *std::max_element(material.emission.begin(), material.emission.end());
  if (brightest > 0) {
    made.material.kind = mesh::MaterialKind::emissive;
    made.material.emission = brightest;
    for (std::size_t k = 0; k < 3; ++k) made.material.color[k] = material.emission[k] / brightest;
  } else if (material.metallic >= 0.5) {
    made.material.kind = mesh::MaterialKind::metal;
    made.material.roughness = material.roughness;
  }
  const double opacity = material.opacity.value_or(1);
  if (opacity < 1 && is_transparent_illumination(material.illumination)) {
    made.material.kind = mesh::MaterialKind::glass;
    made.material.index = material.index > 1 ? material.index : 1.5;
    return made;
  }
  if (!material.opacity_map.file.empty() && made.material.texture >= 0) made.material.alpha_cutoff = 0.5;
  if (opacity == 1) return made;
  const image::Image* picture =
      made.material.alpha_cutoff >= 0 ? &textures.textures[static_cast<std::size_t>(made.material.texture)] : nullptr;
  auto unblended = without_blending(made.material, opacity, picture);
  made.material = unblended.material;
  made.is_exact = unblended.is_exact;
  return made;
}

}  // namespace orbc::mesh_io
