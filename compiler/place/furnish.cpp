#include "compiler/place/furnish.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "compiler/image/image.h"
#include "compiler/mesh/analyse.h"
#include "compiler/mesh/primitives.h"
#include "compiler/place/alpha_mask.h"
#include "compiler/place/bars.h"
#include "compiler/place/locate.h"
#include "compiler/place/stitch.h"
#include "compiler/place/uv_repeats.h"

namespace orbc::place {
namespace {

using scene::Material;
using scene::Pattern;

/// The opacity of an opacity mask: its alpha if it has any, else its brightness (Rec. 709 weights on the encoded values).
std::uint8_t opacity_at(const image::Image& mask, bool by_alpha, double u, double v) {
  const std::uint8_t* p = texel(mask, u, v);
  return by_alpha ? p[3] : static_cast<std::uint8_t>((2126 * p[0] + 7152 * p[1] + 722 * p[2] + 5000) / 10000);
}

/// An image with the colours of one image (or white) and the opacity of another, at the finer resolution of the two.
image::Image masked(const image::Image* colors, const image::Image& mask) {
  bool by_alpha = false;
  for (std::size_t i = 3; i < mask.rgba.size(); i += 4) by_alpha = by_alpha || mask.rgba[i] < 255;
  image::Image made{std::max(mask.width, colors ? colors->width : 1), std::max(mask.height, colors ? colors->height : 1), {}};
  made.rgba.reserve(4 * static_cast<std::size_t>(made.width) * static_cast<std::size_t>(made.height));
  constexpr std::uint8_t kWhite[] = {255, 255, 255};
  for (int y = 0; y < made.height; ++y)
    for (int x = 0; x < made.width; ++x) {
      const double u = (x + 0.5) / made.width, v = (y + 0.5) / made.height;
      const std::uint8_t* color = colors ? texel(*colors, u, v) : kWhite;
      made.rgba.insert(made.rgba.end(), {color[0], color[1], color[2], opacity_at(mask, by_alpha, u, v)});
    }
  return made;
}

/// The earlier object that has the very surface of `mesh`, or null. Each renderer would show another one of the two.
const PlacedMesh* coincident_part(const std::vector<PlacedMesh>& parts, const PlacedMesh& mesh) {
  if (mesh.kind != PartKind::object) return nullptr;
  const auto is_same = [](const geometry::Point& a, const geometry::Point& b) { return a.w == b.w && a.x == b.x && a.y == b.y; };
  for (const PlacedMesh& part : parts) {
    if (part.kind == PartKind::object && part.z == mesh.z && part.triangles == mesh.triangles &&
        std::equal(part.floor.begin(), part.floor.end(), mesh.floor.begin(), mesh.floor.end(), is_same))
      return &part;
  }
  return nullptr;
}

/// The interior under construction. Errors and warnings are collected, so that an author sees all of them at once.
struct Builder {
  const scene::Scene& scene;
  const room::Room& room;
  const mesh::AssetSource& assets;
  const FurnishOptions& options;
  Interior interior;
  Diagnostics errors, warnings;
  std::map<std::string, int> texture_of_path;
  std::map<std::string, mesh::Mesh> mesh_of_path;  ///< by `normal_path`
  std::set<std::string> warned;                    ///< keys of warnings that are given once for many objects

  void fail(Diagnostics diagnostics, const SourceSpan& span) {
    for (Diagnostic& d : located(std::move(diagnostics), span)) errors.push_back(std::move(d));
  }

  [[nodiscard]] std::string path_of(const std::string& written) const {
    return scene.folder.empty() || (!written.empty() && written[0] == '/') ? written : scene.folder + "/" + written;
  }

  // Different spellings of a file's path give the same result.
  [[nodiscard]] std::string normal_path(const std::string& written) const {
    return std::filesystem::path(path_of(written)).lexically_normal().string();
  }

  void warn_once(const std::string& of, Diagnostic warning) {
    if (warned.insert(warning.code + "\n" + of).second) warnings.push_back(std::move(warning));
  }

  int texture(const scene::Located<std::string>& written) {
    const auto known = texture_of_path.find(written.value);
    if (known != texture_of_path.end()) return known->second;
    Result<image::Image> image = assets.load_image(path_of(written.value));
    int index = -1;
    if (image) {
      index = static_cast<int>(interior.textures.size());
      interior.textures.push_back(*std::move(image));
    } else {
      fail(std::move(image).error(), written.span);
    }
    return texture_of_path[written.value] = index;
  }

  // The index of the texture with the material's opacity mask as alpha.
  int masked_texture(const Material& material) {
    const std::string name = (material.pattern == Pattern::texture ? material.texture.value : "") + "\n" + material.opacity_mask.value;
    const auto known = texture_of_path.find(name);
    if (known != texture_of_path.end()) return known->second;
    const int colors = material.pattern == Pattern::texture ? texture(material.texture) : -1, holes = texture(material.opacity_mask);
    int index = -1;
    if (holes >= 0) {
      const image::Image* under = colors >= 0 ? &interior.textures[static_cast<std::size_t>(colors)] : nullptr;
      image::Image made = masked(under, interior.textures[static_cast<std::size_t>(holes)]);
      index = static_cast<int>(interior.textures.size());
      interior.textures.push_back(std::move(made));
    }
    return texture_of_path[name] = index;
  }

  std::uint16_t add(const SurfaceStyle& style) {
    if (interior.styles.size() == 0xffff)
      errors.push_back(make_error("place.too-many-looks", "this scene has more than 65535 different surfaces", "leave some objects out"));
    if (interior.styles.size() < 0xffff + 1) interior.styles.push_back(style);
    return static_cast<std::uint16_t>(interior.styles.size() - 1);
  }

  // Adds the styles of a material: style 0, and style 1 for the second colour of a checker.
  std::vector<std::uint16_t> add_styles(const Material& material) {
    SurfaceStyle style{material.color, -1, material};
    if (material.pattern == Pattern::texture) style.texture = texture(material.texture);
    if (!material.opacity_mask.value.empty()) {
      style.texture = masked_texture(material);
      style.alpha_cutoff = material.alpha_cutoff;
    }
    std::vector<std::uint16_t> styles{add(style)};
    style.color = material.second;
    if (material.pattern == Pattern::checker) styles.push_back(add(style));
    return styles;
  }

  void add_part(PlacedMesh mesh, const std::vector<std::uint16_t>& styles, const SourceSpan& span) {
    bool textured = false;
    for (std::uint16_t& style : mesh.style) {
      style = styles[std::min<std::size_t>(style, styles.size() - 1)];
      textured = textured || interior.styles[style].texture >= 0;
    }
    if (!textured) mesh.uv.clear();
    Result<PlacedMesh> done = cut_at_uv_repeats(room.space, std::move(mesh));
    if (!done) return fail(std::move(done).error(), span);
    if (const PlacedMesh* other = coincident_part(interior.parts, *done)) {
      warnings.push_back(make_warning("place.coincident",
                                      fmt::format("{} stands exactly where {} does and is left out", done->name, other->name),
                                      "remove one of them, or move it", span));
      return;
    }
    interior.parts.push_back(*std::move(done));
  }
};

// ---- the shell --------------------------------------------------------------------------------------------------------------

void build_shell(Builder& builder, const ClippedMirrors& mirrors) {
  const scene::RoomSpec& spec = builder.scene.room;
  Shell shell;
  if (!spec.floor.mirror) shell.floor = spec.floor.material;
  if (!spec.ceiling.mirror) shell.ceiling = spec.ceiling.material;
  for (std::size_t i = 0; i < builder.room.walls.size(); ++i)
    shell.walls.push_back(i < spec.walls.size() ? spec.walls[i].material : Material{});
  PanelOptions options = builder.options.panels;
  const auto measure = [&](const Material& material) {
    if (material.pattern != Pattern::texture) return;
    const int index = builder.texture(material.texture);
    if (index >= 0)
      options.texture_size =
          std::max({options.texture_size, builder.interior.textures[index].width, builder.interior.textures[index].height});
  };
  if (shell.floor) measure(*shell.floor);
  if (shell.ceiling) measure(*shell.ceiling);
  for (const Material& wall : shell.walls) measure(wall);
  Result<std::vector<PlacedMesh>> panels = make_panels(builder.room, spec.height, shell, mirrors.mirrors, options);
  if (!panels) return builder.fail(std::move(panels).error(), spec.span);
  for (PlacedMesh& panel : *panels) {
    const Material& material = panel.kind == PartKind::floor     ? *shell.floor
                               : panel.kind == PartKind::ceiling ? *shell.ceiling
                                                                 : shell.walls[panel.wall];
    if (!material.opacity_mask.value.empty())
      builder.errors.push_back(make_error("place.masked-shell", fmt::format("the {} closes the room and can have no holes", panel.name),
                                          "put the `opacity_mask` on an object", material.opacity_mask.span));
    const std::vector<std::uint16_t> styles = builder.add_styles(material);
    builder.add_part(std::move(panel), styles, material.span);
  }
  const auto& parts = builder.interior.parts;
  if (std::any_of(parts.begin(), parts.end(), [](const PlacedMesh& part) { return !part.uv.empty(); }))
    builder.interior.parts = stitch_panels(builder.room, spec.height, std::move(builder.interior.parts));
}

// ---- objects ----------------------------------------------------------------------------------------------------------------

const mesh::Mesh* load(Builder& builder, const scene::Located<std::string>& path, scene::Axis up) {
  const std::string file = builder.normal_path(path.value);
  const auto known = builder.mesh_of_path.find(file);
  if (known != builder.mesh_of_path.end()) return known->second.triangles.empty() ? nullptr : &known->second;
  Result<mesh::LoadedMesh> loaded = builder.assets.load_mesh(builder.path_of(path.value));
  mesh::Mesh& mesh = builder.mesh_of_path[file];
  if (!loaded) {
    builder.fail(std::move(loaded).error(), path.span);
    return nullptr;
  }
  mesh = std::move(loaded->mesh);
  Diagnostics notes = std::move(loaded->warnings);
  for (Diagnostic& d : mesh::report_warnings(mesh::analyse(mesh), path.value)) notes.push_back(std::move(d));
  for (Diagnostic& d : located(std::move(notes), path.span)) {
    if (d.code != "mesh.y-up" || up == scene::Axis::plus_z) builder.warnings.push_back(std::move(d));
  }
  return &mesh;
}

mesh::Mesh primitive(const scene::Object& object) {
  if (const auto* s = std::get_if<scene::SphereSpec>(&object.shape)) return mesh::make_sphere(s->radius);
  if (const auto* c = std::get_if<scene::CylinderSpec>(&object.shape)) return mesh::make_cylinder(c->radius, c->height);
  if (const auto* b = std::get_if<scene::BoxSpec>(&object.shape)) return mesh::make_box(b->size);
  if (const auto* t = std::get_if<scene::TorusSpec>(&object.shape)) return mesh::make_torus(t->radius, t->tube);
  if (const auto* k = std::get_if<scene::TorusKnotSpec>(&object.shape)) return mesh::make_torus_knot(k->p, k->q, k->radius, k->tube);
  return {};
}

scene::MaterialKind material_kind(mesh::MaterialKind kind) {
  switch (kind) {
    case mesh::MaterialKind::matte:
      return scene::MaterialKind::matte;
    case mesh::MaterialKind::glossy:
      return scene::MaterialKind::glossy;
    case mesh::MaterialKind::metal:
      return scene::MaterialKind::metal;
    case mesh::MaterialKind::glass:
      return scene::MaterialKind::glass;
    case mesh::MaterialKind::emissive:
      return scene::MaterialKind::emissive;
  }
  return scene::MaterialKind::matte;
}

// Adds the styles and textures that a mesh file has.
std::vector<std::uint16_t> add_file_styles(Builder& builder, const mesh::Mesh& mesh, const PlacedMesh& placed) {
  std::vector<std::uint16_t> styles;
  const int first = static_cast<int>(builder.interior.textures.size());
  builder.interior.textures.insert(builder.interior.textures.end(), mesh.textures.begin(), mesh.textures.end());
  for (const mesh::Material& own : mesh.materials) {
    SurfaceStyle style;
    style.color = style.material.color = {own.color[0], own.color[1], own.color[2]};
    style.texture = own.texture >= 0 && !placed.uv.empty() ? first + own.texture : -1;
    style.alpha_cutoff = own.alpha_cutoff;
    style.material.kind = material_kind(own.kind);
    style.material.roughness = own.roughness;
    style.material.index = own.index;
    style.material.emission = own.emission;
    styles.push_back(builder.add(style));
  }
  if (styles.empty()) styles.push_back(builder.add({}));
  return styles;
}

// Removes texture and opacity mask from the material of a mesh without uv, with a warning. In: `what` is the mesh file or the object.
void remove_textures(Builder& builder, const std::string& what, Material& material) {
  if (material.pattern == Pattern::texture) {
    builder.warn_once(what + "\ntexture",
                      make_warning("place.no-uv", fmt::format("{} has no texture coordinates; it is shown in its plain colour", what),
                                   "give it a `color`, or export the mesh with uv", material.span));
    material.pattern = Pattern::plain;
  }
  if (!material.opacity_mask.value.empty()) {
    builder.warn_once(
        what + "\nmask",
        make_warning("place.no-uv", fmt::format("{} has no texture coordinates; it is shown without the holes of its mask", what),
                     "export the mesh with uv", material.opacity_mask.span));
    material.opacity_mask = {};
  }
}

// Adds a mesh in one material. Checkers are solid: cells of the mesh's pattern_position. `file` is the mesh file, if there is one.
void add_in_material(Builder& builder, PlacedMesh mesh, Material material, const SourceSpan& span, const std::string& file = {}) {
  if (mesh.uv.empty()) {
    const std::string kind = mesh.kind == PartKind::frame ? "a mirror's frame" : mesh.name;
    remove_textures(builder, file.empty() ? kind : file, material);
  }
  std::fill(mesh.style.begin(), mesh.style.end(), std::uint16_t{0});
  mesh.color.clear();
  if (material.pattern == Pattern::checker) {
    Result<PlacedMesh> cells = checkered(builder.room.space, std::move(mesh), material.cell);
    if (!cells) return builder.fail(std::move(cells).error(), material.span.source ? material.span : span);
    mesh = *std::move(cells);
  }
  const std::vector<std::uint16_t> styles = builder.add_styles(material);
  builder.add_part(std::move(mesh), styles, span);
}

void build_frames(Builder& builder, const ClippedMirrors& mirrors) {
  std::vector<FrameSpec> specs;
  std::vector<const scene::Frame*> frames;
  for (std::size_t i = 0; i < mirrors.mirrors.size(); ++i) {
    const PlacedMirror& m = mirrors.mirrors[i];
    if (m.wall < 0 || !mirrors.sources[i]->frame) continue;
    specs.push_back({m.wall, {m.span[0], m.span[1]}, {m.height[0], m.height[1]}, mirrors.sources[i]->frame->width});
    frames.push_back(&*mirrors.sources[i]->frame);
  }
  std::vector<PlacedMesh> meshes = make_frames(builder.room, builder.scene.room.height, specs);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (meshes[i].triangles.empty()) continue;
    meshes[i].name = fmt::format("frame on wall {}", specs[i].wall + 1);
    add_in_material(builder, std::move(meshes[i]), frames[i]->material, frames[i]->material.span);
  }
}

void build_beam(Builder& builder, const scene::Object& object, const scene::BarSpec& beam) {
  const double height = builder.scene.room.height;
  Result<geometry::Position> from = locate(beam.from, builder.room, height, 0), to = locate(beam.to, builder.room, height, 0);
  if (!from) builder.fail(std::move(from).error(), object.span);
  if (!to) builder.fail(std::move(to).error(), object.span);
  if (!from || !to) return;
  Result<PlacedMesh> mesh = make_bar(builder.room, height, *from, *to, beam.width);
  if (!mesh) return builder.fail(std::move(mesh).error(), object.span);
  mesh->name = object.name;
  add_in_material(builder, *std::move(mesh), object.material.value_or(Material{}), object.span);
}

void build_object(Builder& builder, const scene::Object& object) {
  if (const auto* beam = std::get_if<scene::BarSpec>(&object.shape)) return build_beam(builder, object, *beam);
  mesh::Mesh own;
  const mesh::Mesh* mesh = &own;
  if (const auto* file = std::get_if<scene::MeshFile>(&object.shape)) mesh = load(builder, file->path, object.up);
  else own = primitive(object);
  if (!mesh) return;
  Result<PlacedMesh> placed = place_object(*mesh, object, builder.room, builder.scene.room.height, builder.options.embed);
  if (!placed) return builder.fail(std::move(placed).error(), object.span);
  const auto* file = std::get_if<scene::MeshFile>(&object.shape);
  if (object.material)
    return add_in_material(builder, *std::move(placed), *object.material, object.span, file ? builder.normal_path(file->path.value) : "");
  const std::vector<std::uint16_t> styles = add_file_styles(builder, *mesh, *placed);
  builder.add_part(*std::move(placed), styles, object.span);
}

}  // namespace

Result<Furnished> furnish(const scene::Scene& scene, const room::Room& room, const mesh::AssetSource& assets,
                          const FurnishOptions& options) {
  Builder builder{scene, room, assets, options, {}, {}, {}, {}, {}, {}};
  builder.interior.polygon = room;
  builder.interior.height = scene.room.height;
  ClippedMirrors mirrors = clipped_mirrors(scene.room, room);
  builder.interior.mirrors = mirrors.mirrors;
  builder.warnings = std::move(mirrors.warnings);
  build_shell(builder, mirrors);
  build_frames(builder, mirrors);
  for (const scene::Object& object : scene.objects) build_object(builder, object);
  if (has_error(builder.errors)) return std::move(builder.errors);
  return Furnished{std::move(builder.interior), std::move(builder.warnings)};
}

}  // namespace orbc::place
