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
#include "compiler/place/beams.h"
#include "compiler/place/locate.h"
#include "compiler/place/seams.h"
#include "compiler/place/texel.h"
#include "compiler/place/wrap.h"

namespace orbc::place {
namespace {

using scene::Material;
using scene::Pattern;

/// Of a mask: its alpha, if it has any, else its brightness (Rec. 709 weights on the codes).
std::uint8_t opacity_at(const image::Image& mask, bool by_alpha, double u, double v) {
  const std::uint8_t* p = texel(mask, u, v);
  return by_alpha ? p[3] : static_cast<std::uint8_t>((2126 * p[0] + 7152 * p[1] + 722 * p[2] + 5000) / 10000);
}

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

/// The room under construction: errors and warnings are collected, so that an author sees all at once.
struct Builder {
  const scene::Scene& scene;
  const room::Room& room;
  const mesh::AssetSource& assets;
  const FurnishOptions& options;
  PlacedRoom placed;
  Diagnostics errors, warnings;
  std::map<std::string, int> texture_of_path;
  std::map<std::string, mesh::Mesh> mesh_of_path;  ///< by `same_path`
  std::set<std::string> told;                      ///< warnings that hold for many objects alike, by what they hold for

  void fail(Diagnostics diagnostics, const SourceSpan& span) {
    for (Diagnostic& d : located(std::move(diagnostics), span)) errors.push_back(std::move(d));
  }

  [[nodiscard]] std::string path_of(const std::string& written) const {
    return scene.folder.empty() || (!written.empty() && written[0] == '/') ? written : scene.folder + "/" + written;
  }

  // However a file's path is written, it is one file.
  [[nodiscard]] std::string same_path(const std::string& written) const {
    return std::filesystem::path(path_of(written)).lexically_normal().string();
  }

  void warn_once(const std::string& of, Diagnostic warning) {
    if (told.insert(warning.code + "\n" + of).second) warnings.push_back(std::move(warning));
  }

  int texture(const scene::Sourced<std::string>& written) {
    const auto known = texture_of_path.find(written.value);
    if (known != texture_of_path.end()) return known->second;
    Result<image::Image> image = assets.load_image(path_of(written.value));
    int index = -1;
    if (image) {
      index = static_cast<int>(placed.textures.size());
      placed.textures.push_back(*std::move(image));
    } else {
      fail(std::move(image).error(), written.span);
    }
    return texture_of_path[written.value] = index;
  }

  // A picture whose alpha is the mask: the texture's colours, or white, at the finer resolution of the two.
  int masked_texture(const Material& material) {
    const std::string name = (material.pattern == Pattern::texture ? material.texture.value : "") + "\n" + material.opacity_mask.value;
    const auto known = texture_of_path.find(name);
    if (known != texture_of_path.end()) return known->second;
    const int colors = material.pattern == Pattern::texture ? texture(material.texture) : -1, holes = texture(material.opacity_mask);
    int index = -1;
    if (holes >= 0) {
      const image::Image* under = colors >= 0 ? &placed.textures[static_cast<std::size_t>(colors)] : nullptr;
      image::Image made = masked(under, placed.textures[static_cast<std::size_t>(holes)]);
      index = static_cast<int>(placed.textures.size());
      placed.textures.push_back(std::move(made));
    }
    return texture_of_path[name] = index;
  }

  std::uint16_t add(const Look& look) {
    if (placed.looks.size() == 0xffff)
      errors.push_back(make_error("place.too-many-looks", "this scene has more than 65535 different surfaces", "leave some objects out"));
    if (placed.looks.size() < 0xffff + 1) placed.looks.push_back(look);
    return static_cast<std::uint16_t>(placed.looks.size() - 1);
  }

  // The looks of a material by the tags that panels carry: 0, and 1 for the second colour of a checker.
  std::vector<std::uint16_t> looks_of(const Material& material) {
    Look look{material.color, -1, material};
    if (material.pattern == Pattern::texture) look.texture = texture(material.texture);
    if (!material.opacity_mask.value.empty()) look.texture = masked_texture(material), look.cutoff = material.cutoff;
    std::vector<std::uint16_t> looks{add(look)};
    look.color = material.second;
    if (material.pattern == Pattern::checker) looks.push_back(add(look));
    return looks;
  }

  void add_part(PlacedMesh mesh, const std::vector<std::uint16_t>& looks, const SourceSpan& span) {
    bool textured = false;
    for (std::uint16_t& look : mesh.look) {
      look = looks[std::min<std::size_t>(look, looks.size() - 1)];
      textured = textured || placed.looks[look].texture >= 0;
    }
    if (!textured) mesh.uv.clear();
    Result<PlacedMesh> done = wrapped(room.space, std::move(mesh));
    if (!done) return fail(std::move(done).error(), span);
    placed.parts.push_back(*std::move(done));
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
      options.texture_size = std::max({options.texture_size, builder.placed.textures[index].width, builder.placed.textures[index].height});
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
    const std::vector<std::uint16_t> looks = builder.looks_of(material);
    builder.add_part(std::move(panel), looks, material.span);
  }
  const auto& parts = builder.placed.parts;
  if (std::any_of(parts.begin(), parts.end(), [](const PlacedMesh& part) { return !part.uv.empty(); }))
    builder.placed.parts = sewn(builder.room, spec.height, std::move(builder.placed.parts));
}

// ---- objects ----------------------------------------------------------------------------------------------------------------

const mesh::Mesh* load(Builder& builder, const scene::Sourced<std::string>& path) {
  const std::string file = builder.same_path(path.value);
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
  for (Diagnostic& d : located(std::move(notes), path.span)) builder.warnings.push_back(std::move(d));
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

// The looks of an object's mesh: the author's material, else what the file says.
std::vector<std::uint16_t> file_looks(Builder& builder, const mesh::Mesh& mesh, const PlacedMesh& placed) {
  std::vector<std::uint16_t> looks;
  const int first = static_cast<int>(builder.placed.textures.size());
  builder.placed.textures.insert(builder.placed.textures.end(), mesh.textures.begin(), mesh.textures.end());
  for (const mesh::Material& own : mesh.materials) {
    Look look;
    look.color = look.material.color = {own.color[0], own.color[1], own.color[2]};
    look.texture = own.texture >= 0 && !placed.uv.empty() ? first + own.texture : -1;
    look.cutoff = own.alpha_cutoff;
    looks.push_back(builder.add(look));
  }
  if (looks.empty()) looks.push_back(builder.add({}));
  return looks;
}

// Takes what needs texture coordinates from the material of a mesh without them. In: what has none: a mesh file, or a thing of its own.
void leave_out_pictures(Builder& builder, const std::string& what, Material& material) {
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

// Adds a mesh in one material. Checkers are solid: cells of the mesh's own coordinates. `file`: of a mesh that comes from one.
void add_in_material(Builder& builder, PlacedMesh mesh, Material material, const SourceSpan& span, const std::string& file = {}) {
  if (mesh.uv.empty()) {
    const std::string kind = mesh.kind == PartKind::frame ? "a mirror's frame" : mesh.name;
    leave_out_pictures(builder, file.empty() ? kind : file, material);
  }
  std::fill(mesh.look.begin(), mesh.look.end(), std::uint16_t{0});
  if (material.pattern == Pattern::checker) {
    Result<PlacedMesh> cells = checkered(builder.room.space, std::move(mesh), material.cell);
    if (!cells) return builder.fail(std::move(cells).error(), material.span.source ? material.span : span);
    mesh = *std::move(cells);
  }
  const std::vector<std::uint16_t> looks = builder.looks_of(material);
  builder.add_part(std::move(mesh), looks, span);
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

void build_beam(Builder& builder, const scene::Object& object, const scene::BeamSpec& beam) {
  const double height = builder.scene.room.height;
  Result<geometry::Position> from = locate(beam.from, builder.room, height, 0), to = locate(beam.to, builder.room, height, 0);
  if (!from) builder.fail(std::move(from).error(), object.span);
  if (!to) builder.fail(std::move(to).error(), object.span);
  if (!from || !to) return;
  Result<PlacedMesh> mesh = make_beam(builder.room, height, *from, *to, beam.width);
  if (!mesh) return builder.fail(std::move(mesh).error(), object.span);
  mesh->name = object.name;
  add_in_material(builder, *std::move(mesh), object.material.value_or(Material{}), object.span);
}

void build_object(Builder& builder, const scene::Object& object) {
  if (const auto* beam = std::get_if<scene::BeamSpec>(&object.shape)) return build_beam(builder, object, *beam);
  mesh::Mesh own;
  const mesh::Mesh* mesh = &own;
  if (const auto* file = std::get_if<scene::MeshFile>(&object.shape)) mesh = load(builder, file->path);
  else own = primitive(object);
  if (!mesh) return;
  Result<PlacedMesh> placed = place_object(*mesh, object, builder.room, builder.scene.room.height, builder.options.embed);
  if (!placed) return builder.fail(std::move(placed).error(), object.span);
  const auto* file = std::get_if<scene::MeshFile>(&object.shape);
  if (object.material)
    return add_in_material(builder, *std::move(placed), *object.material, object.span, file ? builder.same_path(file->path.value) : "");
  const std::vector<std::uint16_t> looks = file_looks(builder, *mesh, *placed);
  builder.add_part(*std::move(placed), looks, object.span);
}

}  // namespace

Result<Furnished> furnish(const scene::Scene& scene, const room::Room& room, const mesh::AssetSource& assets,
                          const FurnishOptions& options) {
  Builder builder{scene, room, assets, options, {}, {}, {}, {}, {}, {}};
  builder.placed.room = room;
  builder.placed.height = scene.room.height;
  ClippedMirrors mirrors = clipped_mirrors(scene.room, room);
  builder.placed.mirrors = mirrors.mirrors;
  builder.warnings = std::move(mirrors.warnings);
  build_shell(builder, mirrors);
  build_frames(builder, mirrors);
  for (const scene::Object& object : scene.objects) build_object(builder, object);
  if (has_error(builder.errors)) return std::move(builder.errors);
  return Furnished{std::move(builder.placed), std::move(builder.warnings)};
}

}  // namespace orbc::place
