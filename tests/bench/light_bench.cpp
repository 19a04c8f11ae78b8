// Baked light by quality, and shadow rays against camera rays of the same room: ratios of one process.
#include <benchmark/benchmark.h>

#include "compiler/bake/diffuse.h"
#include "compiler/driver/load.h"
#include "compiler/render/draw.h"
#include "compiler/trace/follow.h"

using namespace orbc;

namespace {

const driver::LoadedScene& loaded() {
  static const driver::LoadedScene scene = driver::load(ORBC_SOURCE_DIR "/tests/bench/lit.yaml").value();
  return scene;
}

void bake_room(benchmark::State& state, scene::BakeQuality quality, scene::Integrator integrator) {
  scene::Scene scene = loaded().scene;
  scene.bake.quality = quality;
  scene.integrator = integrator;
  const light::LightingContext lighting = light::prepare_light(scene, *loaded().interior, bake::bake_light_options(scene)).value();
  double points = 0, texels = 0;
  for (auto _ : state) {
    const bake::DiffuseBake baked =
        bake::bake_diffuse(*loaded().interior, lighting, bake::bake_options(scene.bake), serial_executor()).value();
    points = static_cast<double>(baked.counts.lit_points), texels = static_cast<double>(baked.counts.texels);
  }
  state.counters["points"] = points, state.counters["texels"] = texels,
  state.counters["images"] = static_cast<double>(lighting.lamps->images.size());
}

// Rays of a small picture, followed through the mirrors: what a stream of camera rays takes a piece.
std::vector<trace::Ray> camera_rays() {
  place::Camera eye = loaded().eye;
  eye.width = 320, eye.height = 240;
  std::vector<trace::Ray> rays;
  for (int y = 0; y < eye.height; ++y)
    for (int x = 0; x < eye.width; ++x) rays.push_back(render::eye_ray(eye, x + 0.5, y + 0.5));
  return rays;
}

void camera(benchmark::State& state) {
  const trace::TraceScene scene = trace::prepare(*loaded().interior);
  const std::vector<trace::Ray> rays = camera_rays();
  for (auto _ : state)
    for (const trace::Ray& ray : rays) benchmark::DoNotOptimize(trace::closest(scene, ray));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
}

void shadow(benchmark::State& state) {
  const trace::TraceScene scene = trace::prepare(*loaded().interior);
  std::vector<trace::Ray> rays;
  std::vector<double> lengths;
  const light::LightingContext lighting = light::prepare_light(loaded().scene, *loaded().interior).value();
  for (const trace::Ray& ray : camera_rays()) {
    const trace::Hit hit = trace::closest(scene, ray);
    const geometry::Position at = trace::position_at(scene.prism.space, ray, hit.t);
    const trace::Segment way = trace::segment_between(scene.prism.space, at, lighting.lamps->lamps.front().centre);
    rays.push_back(way.ray);
    rays.back().t_min = trace::kRayEpsilon;
    lengths.push_back(way.length);
  }
  for (auto _ : state)
    for (std::size_t i = 0; i < rays.size(); ++i) benchmark::DoNotOptimize(trace::occluded(lighting.scene, rays[i], lengths[i]));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
}

}  // namespace

BENCHMARK_CAPTURE(bake_room, draft, scene::BakeQuality::draft, scene::Integrator::direct)
    ->Name("bake/draft")
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK_CAPTURE(bake_room, normal, scene::BakeQuality::normal, scene::Integrator::direct)
    ->Name("bake/normal")
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK_CAPTURE(bake_room, normal_path, scene::BakeQuality::normal, scene::Integrator::path)
    ->Name("bake/normal_path")
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK(camera);
BENCHMARK(shadow);

BENCHMARK_MAIN();
