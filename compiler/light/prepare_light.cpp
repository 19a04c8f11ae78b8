// What lighting needs before it can be asked: lamps with their images, shadow casters, normals, and the grid that finds images.
#include <algorithm>
#include <utility>

#include "compiler/light/guide.h"
#include "compiler/light/lighting.h"
#include "compiler/place/alpha_mask.h"

namespace orbc::light {
namespace {

Result<LampSet> with_images(const scene::Scene& scene, const place::Interior& interior, PlacedLamps placed, const LightOptions& options) {
  LampSet set{std::move(placed.lamps), {}, std::move(placed.warnings), {}, 1};
  for (PlacedLamp& lamp : set.lamps) lamp.hot_spots = find_hot_spots(lamp, interior);
  auto images = lamp_images(set.lamps, interior, {options.bounces, scene.exposure, options.cull_below});
  if (!images) return located(images.error(), scene.bake.mirror_bounces_span);
  set.images = std::move(images->images);
  set.faint = std::move(images->faint);
  if (options.cull_below > 0) set.faint_share = images->faint_below / options.cull_below;
  return set;
}

/// The room without the bodies of its lamps.
std::shared_ptr<const place::Interior> make_shadow_casters(const place::Interior& interior) {
  auto casters = std::make_shared<place::Interior>(interior);
  if (!place::has_alpha_mask(interior)) casters->textures.clear();
  casters->parts.erase(
      std::remove_if(casters->parts.begin(), casters->parts.end(), [](const place::PlacedMesh& part) { return lamp_of_part(part) >= 0; }),
      casters->parts.end());
  return casters;
}

}  // namespace

LightOptions light_options(const scene::Scene& scene) {
  LightOptions options;
  options.bounces = scene.bake.mirror_bounces;
  if (scene.integrator == scene::Integrator::path) options.indirect_bounces = scene.bake.indirect_bounces;
  options.path_bounces = scene.cover.max_bounces;
  options.path_min_weight = scene.cover.min_weight;
  options.background = (1 / std::max(scene.exposure, 1e-300)) * scene.cover.background;
  options.seed = static_cast<std::uint64_t>(scene.bake.seed);
  return options;
}

Result<LampSet> prepare_lamps(const scene::Scene& scene, const place::Interior& interior, const LightOptions& options) {
  auto placed = place_lamps(scene, interior.polygon);
  if (!placed) return placed.error();
  if (auto inside = lamps_inside_objects(scene, placed->lamps, interior); !inside.empty()) return inside;
  return with_images(scene, interior, std::move(*placed), options);
}

LightingContext prepare_light(const scene::Scene& scene, const place::Interior& interior, std::shared_ptr<const LampSet> lamps,
                              const LightOptions& options, const Executor& executor) {
  LightingContext lighting;
  lighting.lit = !scene.lamps.empty() || options.indirect_bounces > 0;
  lighting.exposure = scene.exposure;
  if (!lighting.lit) {
    lighting.ambient = {1, 1, 1};
    return lighting;
  }
  lighting.ambient = scene.ambient;
  lighting.options = options;
  lighting.faint_below = options.cull_below * lamps->faint_share;
  lighting.lamps = std::move(lamps);
  lighting.normals.resize(interior.parts.size());
  executor(interior.parts.size(), [&](std::size_t i) { lighting.normals[i] = surface::part_normals(interior, interior.parts[i]); });
  lighting.shadow_casters = make_shadow_casters(interior);
  lighting.scene = trace::prepare(*lighting.shadow_casters, executor);
  lighting.cull_grid = make_light_cull_grid(lighting, executor);
  return lighting;
}

Result<LightingContext> prepare_light(const scene::Scene& scene, const place::Interior& interior, const LightOptions& options,
                                      const Executor& executor) {
  auto placed = place_lamps(scene, interior.polygon);
  if (!placed) return placed.error();
  auto lamps = with_images(scene, interior, std::move(*placed), options);
  if (!lamps) return lamps.error();
  return prepare_light(scene, interior, std::make_shared<const LampSet>(std::move(*lamps)), options, executor);
}

}  // namespace orbc::light
