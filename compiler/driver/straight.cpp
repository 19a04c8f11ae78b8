#include "compiler/driver/straight.h"

#include <algorithm>
#include <complex>

#include "compiler/geometry/chart.h"
#include "compiler/notation/classify.h"
#include "compiler/render/straight.h"

namespace orbc::driver {
bool draws_straight(const scene::Scene& scene) {
  if (scene.rays != scene::Rays::straight) return false;
  const auto space = notation::classify(scene.orbifold);
  return space && *space != geometry::Space::euclidean;
}

CompileOptions with_rays(CompileOptions options, const scene::Scene& scene, const place::Camera& eye) {
  if (options.bend.view != bend::View::eye || !draws_straight(scene)) return options;
  const geometry::Point foot = eye.room_from_eye * geometry::Point();
  const std::complex<double> at = render::kStraightScale * geometry::disk_from_point(eye.room_from_eye.space, foot);
  options.bend.view = bend::View::disk;
  options.bend.chart_scale = render::kStraightScale;
  options.bend.chart_eye = geometry::Vector3{at.real(), at.imag(), eye.z};
  if (options.budget) options.bend.max_triangles = *options.budget;
  options.budget.reset();
  return options;
}

Diagnostics straight_note(const LoadedScene& loaded) {
  const scene::Scene& scene = loaded.scene;
  const bool is_lit = !scene.lamps.empty() || scene.integrator == scene::Integrator::path;
  const auto& styles = loaded.interior->styles;
  const bool shines = std::any_of(styles.begin(), styles.end(), [](const place::SurfaceStyle& style) {
    return style.material.kind != scene::MaterialKind::matte && style.material.kind != scene::MaterialKind::emissive;
  });
  if (!draws_straight(scene) || !is_lit || !shines) return {};
  return {
      make_note("driver.straight-light",
                "straight rays show the light that does not depend on the eye: highlights, and what mirrors, glass and metals reflect, are "
                "left out",
                "", scene.span)};
}

}  // namespace orbc::driver
