#include "compiler/bake/bake_options.h"

#include <algorithm>

#include "compiler/surface/albedo.h"

namespace orbc::bake {

BakeOptions bake_options(const scene::BakeSpec& spec) {
  BakeOptions options;
  if (spec.quality == scene::BakeQuality::draft) {
    options.min_density = 12;
    options.max_density = 48;
    options.texture_density = 200;
    options.tolerance = 5;
    options.radiosity = {64, 10};
  }
  if (spec.quality == scene::BakeQuality::fine) {
    options.min_density = 48;
    options.max_density = 400;
    options.texture_density = 600;
    options.tolerance = 1;
    options.radiosity = {1024, 48};
  }
  if (spec.samples) options.radiosity.samples = *spec.samples;
  return options;
}

light::LightOptions bake_light_options(const scene::Scene& scene) {
  light::LightOptions options = light::light_options(scene);
  if (scene.bake.quality == scene::BakeQuality::draft) {
    options.cull_below = 1.0 / 128;
    options.max_step = 0.025;
  }
  if (scene.bake.quality == scene::BakeQuality::fine) options.max_step = 0.003;
  return options;
}

bool is_specular(const scene::Material& material, bool lit) {
  using Kind = scene::MaterialKind;
  return material.kind == Kind::mirror || material.kind == Kind::glass || (lit && material.kind == Kind::metal);
}

bool is_specular(const place::Interior& interior, bool lit) {
  return std::any_of(interior.styles.begin(), interior.styles.end(),
                     [&](const place::SurfaceStyle& style) { return is_specular(style.material, lit); });
}

bool needs_bake(const scene::Scene& scene, const place::Interior& interior) {
  if (!scene.lamps.empty() || is_specular(interior, false) || scene.integrator == scene::Integrator::path) return true;
  return std::any_of(interior.parts.begin(), interior.parts.end(), [&](const place::PlacedMesh& part) {
    return std::any_of(part.style.begin(), part.style.end(), [&](std::uint16_t style) {
      const bool is_picture_alone = interior.styles[style].texture >= 0 && part.color.empty();
      return !is_picture_alone && surface::varies_in_triangle(interior, part, style);
    });
  });
}

}  // namespace orbc::bake
