// Materials: a preset ("marble"), a colour ("coral"), or {kind: …, color: …, checker: [a, b], texture: path, …}.
// Metals: reflectance at normal incidence of the pure metals, linear Rec. 709 (Akenine-Möller et al., Real-Time Rendering, 4th ed., table
// 9.2).
#include <fmt/format.h>

#include <algorithm>

#include "compiler/scene/readers.h"

namespace orbc::scene {
namespace {

Material solid(MaterialKind kind, Color color, double roughness) {
  Material material;
  material.kind = kind;
  material.color = color;
  material.roughness = roughness;
  return material;
}

Material patterned(MaterialKind kind, Pattern pattern, unsigned color, unsigned second, double cell, double roughness) {
  Material material = solid(kind, from_hex(color), roughness);
  material.pattern = pattern;
  material.second = from_hex(second);
  material.cell = cell;
  return material;
}

struct Preset {
  const char* name;
  Material material;
};

const std::vector<Preset>& presets() {
  using Kind = MaterialKind;
  static const std::vector<Preset> all = {
      {"chrome", solid(Kind::metal, {0.550, 0.556, 0.554}, 0.05)},
      {"copper", solid(Kind::metal, {0.955, 0.638, 0.538}, 0.15)},
      {"glass", solid(Kind::glass, {1, 1, 1}, 0)},
      {"gold", solid(Kind::metal, {1.000, 0.782, 0.344}, 0.15)},
      {"granite", patterned(Kind::glossy, Pattern::granite, 0x9A8F8A, 0x3B3637, 0.05, 0.25)},
      {"marble", patterned(Kind::glossy, Pattern::marble, 0xF4F1EA, 0x77727C, 0.30, 0.15)},
      {"mirror", solid(Kind::mirror, {0.95, 0.95, 0.95}, 0)},
      {"plaster", solid(Kind::matte, from_hex(0xE8E4DA), 1)},
      {"porcelain", solid(Kind::glossy, from_hex(0xF8F8F4), 0.1)},
      {"silver", solid(Kind::metal, {0.972, 0.960, 0.915}, 0.1)},
      {"wood", patterned(Kind::glossy, Pattern::wood, 0xC08A4D, 0x7A4A22, 0.10, 0.5)},
  };
  return all;
}

const std::vector<std::string>& pattern_keys() {
  static const std::vector<std::string> keys = {"checker", "marble", "wood", "granite", "texture", "pattern"};
  return keys;
}

Pattern pattern_named(std::string_view name) {
  return name == "checker" ? Pattern::checker : name == "marble" ? Pattern::marble : name == "wood" ? Pattern::wood : Pattern::granite;
}

// Reads `checker: [a, b]`, `texture: path` or `pattern: checker`, at most one of them, with its colours.
void read_pattern(const Fields& fields, Material& material) {
  Reader& reader = fields.reader();
  const std::string key = fields.only_one_of(pattern_keys());
  if (key.empty()) return;
  if (key == "pattern") {
    material.pattern = fields.choice<Pattern>("pattern", material.pattern,
                                              {{"plain", Pattern::plain},
                                               {"checker", Pattern::checker},
                                               {"marble", Pattern::marble},
                                               {"wood", Pattern::wood},
                                               {"granite", Pattern::granite}});
    return;
  }
  const Node& node = *fields.find(key);
  if (key == "texture") {
    material.pattern = Pattern::texture;
    if (!fields.has("color")) material.color = {1, 1, 1};  // the colour multiplies the picture
    if (auto path = reader.text(node, "`texture`")) material.texture = {*path, node.span};
    return;
  }
  material.pattern = pattern_named(key);
  for (const char* other : {"color", "second"})
    if (fields.has(other))
      reader.error("scene.conflict", fields.key_span(other),
                   fmt::format("`{}` names both colours already, `{}` cannot stand beside it", key, other), "keep one of the two");
  if (!reader.list(node, fmt::format("`{}`", key), 2, "a list of two colours")) return;
  material.color = reader.color(node.items[0], "the first colour", material.color);
  material.second = reader.color(node.items[1], "the second colour", material.second);
}

// Reads `opacity_mask` and `cutoff`. Only opaque materials with one colour or a texture can have a mask.
void read_mask(const Fields& fields, Material& material) {
  material.alpha_cutoff = fields.number("cutoff", material.alpha_cutoff, kUnit);
  const Node* node = fields.find("opacity_mask");
  if (!node) return fields.no_effect("cutoff", "it says where an `opacity_mask` has holes, and there is none");
  Reader& reader = fields.reader();
  if (auto path = reader.text(*node, "`opacity_mask`")) material.opacity_mask = {*path, node->span};
  const auto conflict = [&](const char* what) {
    reader.error("scene.cannot-be-masked", fields.key_span("opacity_mask"), fmt::format("an `opacity_mask` does not go with {}", what),
                 "keep one of the two");
  };
  if (material.kind == MaterialKind::mirror || material.kind == MaterialKind::glass) conflict("mirror and glass");
  if (material.pattern != Pattern::plain && material.pattern != Pattern::texture) conflict("solid patterns");
}

void warn_unused_keys(const Fields& fields, const Material& material) {
  using Kind = MaterialKind;
  const bool rough = material.kind == Kind::glossy || material.kind == Kind::metal;
  if (!rough) fields.no_effect("roughness", "it belongs to `kind: glossy` and `kind: metal`; others are matte or perfectly smooth");
  if (material.kind != Kind::glass) fields.no_effect("index", "it belongs to `kind: glass`");
  if (material.kind != Kind::emissive) fields.no_effect("emission", "it belongs to `kind: emissive`");
  const bool plain = material.pattern == Pattern::plain;
  if (plain) fields.no_effect("cell", "it is the size of a pattern, and there is none");
  if (plain || material.pattern == Pattern::texture) fields.no_effect("second", "it is the other colour of a pattern, and there is none");
}

void read_keys(const Fields& fields, Material& material) {
  material.kind = fields.choice<MaterialKind>("kind", material.kind,
                                              {{"matte", MaterialKind::matte},
                                               {"glossy", MaterialKind::glossy},
                                               {"metal", MaterialKind::metal},
                                               {"mirror", MaterialKind::mirror},
                                               {"glass", MaterialKind::glass},
                                               {"emissive", MaterialKind::emissive}});
  read_pattern(fields, material);
  material.color = fields.color("color", material.color);
  material.second = fields.color("second", material.second);
  material.cell = fields.number("cell", material.cell, {1e-9, kMaxLength});
  material.roughness = fields.number("roughness", material.roughness, kUnit);
  material.index = fields.number("index", material.index, {1, 5});
  material.emission = fields.number("emission", material.emission, {0, 1e6});
  read_mask(fields, material);
  warn_unused_keys(fields, material);
}

Material read_named(Reader& reader, const Node& node, const std::string& what, const Material& base) {
  if (auto preset = preset_material(node.text)) return *preset;
  Material material = base;
  if (const auto color = parse_color(node.text)) {
    material.color = *color;
    return material;
  }
  std::vector<std::string> known = preset_names();
  known.insert(known.end(), color_names().begin(), color_names().end());
  const std::string nearest = nearest_word(node.text, known);
  reader.error("scene.unknown-material", node.span,
               fmt::format("{} must be a colour, a map of material keys, or {}", what, listed(preset_names())),
               nearest.empty() ? "" : fmt::format("did you mean `{}`?", nearest));
  return material;
}

}  // namespace

const std::vector<std::string>& material_keys() {
  static const std::vector<std::string> keys = {"material",  "preset", "kind",     "color",        "second",  "pattern",
                                                "checker",   "marble", "wood",     "granite",      "texture", "cell",
                                                "roughness", "index",  "emission", "opacity_mask", "cutoff"};
  return keys;
}

bool has_material_key(const Fields& fields) {
  return std::any_of(material_keys().begin(), material_keys().end(), [&](const std::string& key) { return fields.has(key); });
}

std::optional<Material> preset_material(std::string_view name) {
  for (const Preset& preset : presets())
    if (preset.name == name) return preset.material;
  return std::nullopt;
}

const std::vector<std::string>& preset_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Preset& preset : presets()) all.emplace_back(preset.name);
    return all;
  }();
  return names;
}

Material read_material_keys(const Fields& fields, const Material& base) {
  Reader& reader = fields.reader();
  Material material = base;
  if (const Node* node = fields.find("material")) {
    for (const std::string& key : material_keys())
      if (key != "material" && fields.has(key))
        reader.error("scene.conflict", fields.key_span(key), fmt::format("`{}` must stand inside `material`, since that is given", key),
                     "keep one of the two");
    return read_material(reader, *node, "`material`", base);
  }
  if (const Node* node = fields.find("preset")) {
    if (const auto preset = node->kind == NodeKind::scalar ? preset_material(node->text) : std::nullopt) material = *preset;
    else reader.unknown_value(*node, "`preset`", preset_names());
  }
  read_keys(fields, material);
  material.span = fields.node().span;
  return material;
}

Material read_material(Reader& reader, const Node& node, const std::string& what, const Material& base) {
  Material material = base;
  if (node.kind == NodeKind::scalar) material = read_named(reader, node, what, base);
  else if (node.kind == NodeKind::list) material.color = reader.color(node, what, base.color);
  else {
    std::vector<std::string> keys = material_keys();
    keys.erase(keys.begin());  // `material` is no key inside `material`
    material = read_material_keys(Fields(reader, node, what, keys), base);
  }
  material.span = node.span;
  return material;
}

}  // namespace orbc::scene
