#include "compiler/driver/paint.h"

#include <algorithm>

#include "compiler/driver/prepared.h"
#include "compiler/driver/see_in.h"

namespace orbc::driver {
namespace {

/// Of a scene without lamps.
light::LightingContext dark(const scene::Scene& scene) {
  light::LightingContext lighting;
  lighting.ambient = {1, 1, 1};
  lighting.exposure = scene.exposure;
  return lighting;
}

// Plain colours are what lit ones are without light: seen at the scene's exposure, and times its emission where something glows.
place::Interior exposed(place::Interior room, double exposure) {
  for (place::SurfaceStyle& look : room.styles)
    look.color = (exposure * (look.material.kind == scene::MaterialKind::emissive ? look.material.emission : 1)) * look.color;
  return room;
}

/// By how much the points of a bake lie denser than its options say: these mean rooms of some units. In a tiny one no shadow would be
/// found, and of a huge one no picture would hold all points.
double density_for(const place::Interior& room) {
  constexpr double kSmall = 0.5, kLarge = 64;
  const double extent = std::max(room.polygon.circumradius, room.height);
  return extent < kSmall ? 1 / extent : extent > kLarge ? kLarge / extent : 1;
}

}  // namespace

Result<Painted> paint(const Opened& opened, const place::Interior& room, const std::vector<cover::Copy>& copies,
                      const bake::DrawnParts& drawn, const bake::BakeOptions& baking, const PaintOptions& options, const Executor& executor,
                      const Progress& progress) {
  Painted painted;
  if (!bake::needs_bake(opened.scene, *opened.room)) {
    auto atlas = bake::make_atlas(exposed(room, opened.scene.exposure), {options.max_side, options.with_image16});
    if (!atlas) return atlas.error();
    painted.atlas = std::move(*atlas);
    return painted;
  }
  painted.baked = true;
  light::LightingContext lighting = options.lit ? prepared(opened, executor).light : dark(opened.scene);
  lighting.options = bake::bake_light_options(opened.scene);
  bake::BakeOptions bake = baking;
  bake.max_side = options.max_side;
  bake.with_image16 = options.with_image16;
  const double denser = density_for(*opened.room);
  bake.min_density *= denser, bake.max_density *= denser, bake.texture_density *= denser;
  if (!options.lit) bake.min_density = bake.max_density = bake.texture_density = 0.01, lighting.options.indirect_bounces = 0;
  auto baked = bake::bake_diffuse(room, lighting, bake, executor, progress);
  if (!baked) return baked.error();
  if (options.highlights && options.lit && bake::needs_view_bake(*opened.room, lighting)) {
    bake::ViewBakeOptions shine = bake::view_bake_options(opened.scene.bake);
    shine.max_side = options.max_side;
    if (bake::is_specular(*opened.room, lighting.lit)) shine.specular = see_in(opened, &*baked, executor);
    bake::ViewBake view = bake::bake_view_dependent({room, lighting, *baked, copies, drawn, opened.eye}, shine, executor, progress);
    baked->atlas.image = std::move(view.image);
    baked->atlas.image16 = std::move(view.image16);
    baked->atlas.uv = std::move(view.uv);
    painted.copy_uv = std::move(view.copy_uv);
    painted.view_counts = view.counts;
  }
  painted.atlas = std::move(baked->atlas);
  return painted;
}

void add_highlights(const Painted& painted, std::vector<bend::Model>& models, std::vector<std::uint32_t>& model_of_copy) {
  const std::vector<bake::CopyUv>& all = painted.copy_uv;
  for (std::size_t i = 0; i < all.size();) {
    const std::size_t copy = all[i].copy;
    bend::Model model = models[model_of_copy[copy]];
    for (; i < all.size() && all[i].copy == copy; ++i)
      for (bend::Model::Part& part : model.parts)
        if (part.mesh == &painted.atlas.room.parts[all[i].part]) part.uv = &all[i].uv;
    model_of_copy[copy] = static_cast<std::uint32_t>(models.size());
    models.push_back(std::move(model));
  }
}

}  // namespace orbc::driver
