#include "compiler/driver/appearance.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "compiler/bake/dimmed_light.h"
#include "compiler/driver/specular_query.h"

namespace orbc::driver {
namespace {

/// The impostors in one list.
std::vector<place::PlacedMesh> all_of(PicturePanels panels) {
  std::vector<place::PlacedMesh> all = std::move(panels.depth);
  std::move(panels.size.begin(), panels.size.end(), std::back_inserter(all));
  return all;
}

/// The interior with the styles of impostors (cutoff::ImpostorPanels says which these are): they emit the radiance behind them.
place::Interior with_impostor_styles(place::Interior interior, const cutoff::CutoffEstimate& endings) {
  const auto add = [&](const scene::Color& color) {
    place::SurfaceStyle style;
    style.color = color;
    style.material.kind = scene::MaterialKind::emissive;
    interior.styles.push_back(style);
  };
  add(endings.color);
  for (const scene::Color& color : endings.color_by_band) add(color);
  return interior;
}

/// Plain scenes: one color or texture per style.
Result<Appearance> plain_appearance(const Job& job, std::vector<place::PlacedMesh> panels, const cutoff::CutoffEstimate& endings) {
  const Result<DrawnSurfaces>& surfaces = job.scene.surfaces(job.run);
  if (!surfaces) return surfaces.error();
  const bake::Atlas& plain = surfaces->plain;
  if (panels.empty()) return Appearance{plain.image, plain.image16, plain.uv, {}, {}, {}, {}, 2};
  const scene::Scene& scene = job.scene.scene();
  place::Interior interior = with_impostor_styles(job.scene.lods(job.run).interior, endings);
  const auto meshes = static_cast<std::ptrdiff_t>(interior.parts.size());
  std::move(panels.begin(), panels.end(), std::back_inserter(interior.parts));
  auto atlas = bake::make_atlas(with_exposure(std::move(interior), scene.exposure),
                                {job.scene.options().max_atlas_side, scene.bake.atlas != scene::AtlasFormat::srgb8});
  if (!atlas) return atlas.error();
  Appearance appearance{std::move(atlas->image), std::move(atlas->image16), std::move(atlas->uv), {}, {}, {}, {}, 2};
  appearance.panels.assign(std::make_move_iterator(atlas->room.parts.begin() + meshes), std::make_move_iterator(atlas->room.parts.end()));
  appearance.panel_uv.assign(std::make_move_iterator(appearance.uv.begin() + meshes), std::make_move_iterator(appearance.uv.end()));
  appearance.uv.resize(static_cast<std::size_t>(meshes));
  return appearance;
}

/// The baked light of impostors: that which they emit.
bake::DiffuseTexels bake_panels(const Job& job, const std::vector<place::PlacedMesh>& panels,
                                const std::vector<std::vector<bake::TexelPatch>>& patches, const cutoff::CutoffEstimate& endings) {
  place::Interior interior;
  interior.polygon = job.scene.interior().polygon;
  interior.height = job.scene.interior().height;
  interior.styles = job.scene.interior().styles;
  interior.parts = panels;
  light::LightingContext unlit;
  unlit.exposure = job.scene.scene().exposure;
  return bake::bake_texels(with_impostor_styles(std::move(interior), endings), patches, unlit, bake_options(job.scene), job.run.executor);
}

/// The parts and levels that copies are drawn from, and, as the tracer finds them in mirrors, all parts at level 0.
std::vector<bool> used_parts(const lod::InteriorWithLods& lods, const lod::LodSelection& selection) {
  std::vector<bool> used(lods.interior.parts.size(), false);
  std::fill_n(used.begin(), room_part_count(lods), true);
  for (const std::vector<std::uint16_t>& levels : selection.levels_of_model)
    for (std::size_t p = 0; p < levels.size(); ++p) used[lods.part_of_level[p][levels[p]]] = true;
  return used;
}

bake::DrawnParts drawn_parts(const lod::InteriorWithLods& lods, const lod::LodSelection& selection) {
  bake::DrawnParts drawn{{}, selection.model_of_copy, lods.surface_offset};
  for (const std::vector<std::uint16_t>& levels : selection.levels_of_model) {
    drawn.models.emplace_back();
    for (std::size_t p = 0; p < levels.size(); ++p) drawn.models.back().push_back(lods.part_of_level[p][levels[p]]);
  }
  return drawn;
}

/// Bakes what depends on the eye: highlights, and the reflections of mirror, glass and metal objects. Nothing where no surface shows any.
std::optional<bake::ViewBake> bake_for_eye(const Job& job, const Detail& detail, const bake::DiffuseBake& baked) {
  if (!job.options.highlights || job.options.bend.view != bend::View::eye) return std::nullopt;
  const place::Interior& interior = job.scene.interior();
  const light::LightingContext lighting = baked_lighting(job.scene, job.run);
  if (!bake::needs_view_bake(interior, lighting)) return std::nullopt;
  bake::ViewBakeOptions options = bake::view_bake_options(job.scene.scene().bake);
  options.max_side = job.scene.options().max_atlas_side;
  if (bake::is_specular(interior, lighting.lit)) options.specular = specular_query(job.scene, job.eye, &baked, job.run);
  const lod::InteriorWithLods& lods = job.scene.lods(job.run);
  const bake::DrawnParts drawn = drawn_parts(lods, detail.selection);
  return bake::bake_view_dependent({lods.interior, lighting, baked, detail.copies, drawn, job.eye}, options, job.run.executor,
                                   job.run.progress);
}

/// Baked scenes: texels for every surface.
Result<Appearance> baked_appearance(const Job& job, const Detail& detail, std::vector<place::PlacedMesh> panels,
                                    const cutoff::CutoffEstimate& endings) {
  const lod::InteriorWithLods& lods = job.scene.lods(job.run);
  const std::vector<std::vector<bake::TexelPatch>>& patches = job.scene.surfaces(job.run)->patches;
  const bake::DiffuseTexels& diffuse = job.scene.diffuse(job.run);
  DrawnPanels drawn = drawn_panels(job.scene, panels);
  const bake::DiffuseTexels panel_texels = bake_panels(job, panels, drawn.patches, endings);
  const std::vector<bool> used = used_parts(lods, detail.selection);
  std::vector<bake::PartToPack> parts(used.size());
  for (std::size_t p = 0; p < used.size(); ++p)
    if (used[p]) parts[p] = {&lods.interior.parts[p].name, &patches[p], &diffuse.parts[p]};
  for (std::size_t p = 0; p < panels.size(); ++p) parts.push_back({&panels[p].name, &drawn.patches[p], &panel_texels.parts[p]});
  auto baked = bake::pack_texels(parts, bake_options(job.scene));
  if (!baked) return baked.error();
  auto for_eye = bake_for_eye(job, detail, *baked);
  bake::ViewBake view =
      for_eye ? std::move(*for_eye)
              : bake::ViewBake{std::move(baked->atlas.image), std::move(baked->atlas.image16), std::move(baked->atlas.uv), {}, {}, 2, {}};
  bake::ViewBakeOptions options;
  options.max_side = job.scene.options().max_atlas_side;
  view = bake::add_dimmed_light(std::move(view), *baked, detail.copies, drawn_parts(lods, detail.selection), options);
  Appearance appearance;
  appearance.image = std::move(view.image);
  appearance.image16 = std::move(view.image16);
  appearance.uv = std::move(view.uv);
  appearance.copy_uv = std::move(view.copy_uv);
  appearance.view_counts = view.counts;
  appearance.first_dimmed_v = view.first_dimmed_v;
  appearance.panels = std::move(drawn.meshes);
  const auto first_panel = appearance.uv.begin() + static_cast<std::ptrdiff_t>(used.size());
  appearance.panel_uv.assign(std::make_move_iterator(first_panel), std::make_move_iterator(appearance.uv.end()));
  appearance.uv.resize(used.size());
  return appearance;
}

}  // namespace

Result<Appearance> make_appearance(const Job& job, const Detail& detail, const cutoff::CutoffEstimate& endings) {
  report(job.run.progress, "atlas", 0, 0);
  std::vector<place::PlacedMesh> panels = all_of(picture_panels(job, detail));
  return job.scene.is_baked() ? baked_appearance(job, detail, std::move(panels), endings)
                              : plain_appearance(job, std::move(panels), endings);
}

Result<Appearance> without_colors(const Job& job, const Detail& detail) {
  const Result<DrawnSurfaces>& surfaces = job.scene.surfaces(job.run);
  if (!surfaces) return surfaces.error();
  Appearance appearance;
  for (const place::PlacedMesh& mesh : surfaces->meshes) appearance.uv.emplace_back(mesh.floor.size());
  appearance.panels = drawn_panels(job.scene, all_of(picture_panels(job, detail))).meshes;
  for (const place::PlacedMesh& panel : appearance.panels) appearance.panel_uv.emplace_back(panel.floor.size());
  return appearance;
}

}  // namespace orbc::driver
