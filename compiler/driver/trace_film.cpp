#include "compiler/driver/trace_film.h"

#include <algorithm>
#include <optional>

#include "compiler/bake/diffuse.h"
#include "compiler/cutoff/estimate.h"
#include "compiler/driver/unit_of_length.h"
#include "compiler/render/draw.h"

namespace orbc::driver {
namespace {

constexpr int kBakeSamplesPerPath = 32;

/// Paths of light between surfaces for each sample of a pixel.
int path_count(const scene::BakeSpec& spec) { return std::max(1, bake::bake_options(spec).radiosity.samples / kBakeSamplesPerPath); }

/// Where light is interpolated only where it is smooth, points at borders of shadows need not be denser than the pixels of the picture:
/// samples there are lit by themselves. In rooms that are larger than a unit of length, most is seen from farther away than that.
bake::BakeOptions cache_options(const PreparedScene& scene, const place::Camera& eye) {
  constexpr double kDensityPerPixel = 0.25;  // times pixels per radian, which is their density at distance 1
  bake::BakeOptions options = bake_options(scene, {});  // whatever the quality of exports
  const double distance = std::max({1.0, scene.interior().polygon.circumradius, scene.interior().height});
  options.min_density /= distance;
  options.max_density = std::clamp(kDensityPerPixel / distance * place::pixels_per_radian(eye), options.min_density, options.max_density);
  return options;
}

}  // namespace

render::DrawOptions draw_options(const PreparedScene& prepared, const place::Camera& eye, const Run& run) {
  const scene::Scene& scene = prepared.scene();
  const TraceContext& context = prepared.trace_context(run);
  const light::LightingContext& lighting = context.lighting;
  render::DrawOptions draw;
  draw.lighting = lighting.lit ? &lighting : nullptr;
  draw.paths = path_count(scene.bake);
  draw.max_bounces = scene.cover.max_bounces;
  draw.min_weight = scene.cover.min_weight;
  draw.background = scene.cover.background;
  // The film is exposed as a whole; the background is not.
  if (lighting.exposure > 0) {
    draw.background = (1 / lighting.exposure) * draw.background;
    draw.max_radiance = 1 / lighting.exposure;
  }
  if (scene.cover.background_expected)
    draw.background = cutoff::estimate_cutoff({scene, eye, context.tracer, &lighting}, {true, {}, {}}, run.executor).color;
  return draw;
}

render::Film trace_film(const PreparedScene& scene, const place::Camera& eye, const TraceOptions& options, const Executor& executor,
                        const Progress& progress) {
  const Run run{executor, progress};
  render::DrawOptions draw = draw_options(scene, eye, run);
  draw.samples = options.samples;
  if (options.path_quality) {
    scene::BakeSpec spec = scene.scene().bake;
    spec.quality = *options.path_quality;
    draw.paths = path_count(spec);
  }
  std::optional<bake::IrradianceCache> irradiance;
  if (draw.lighting && !options.exact)
    draw.irradiance = &irradiance.emplace(scene.interior(), *draw.lighting, cache_options(scene, eye));
  return in_author_unit(render::draw(scene.trace_context(run).tracer, eye, draw, executor, progress), scene.loaded().unit_of_length);
}

render::Film trace_film(const LoadedScene& scene, const TraceOptions& options, const Executor& executor, const Progress& progress) {
  return trace_film(PreparedScene(scene), scene.eye, options, executor, progress);
}

}  // namespace orbc::driver
