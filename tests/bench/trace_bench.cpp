// The tracer's parts by themselves: building the tree, camera rays, mirror paths, shadow rays. Ratios to Embree: trace_ratio_bench.cpp.
#include <benchmark/benchmark.h>

#include <map>
#include <memory>

#include "tests/bench/trace_scenes.h"

using namespace orbc;
using namespace orbc::trace;
using namespace orbc::trace::bench;

namespace {

/// Cases are built once: argument 0 the curvature, 1 the number of triangles.
const Case& case_of(const benchmark::State& state) {
  static std::map<std::pair<std::int64_t, std::int64_t>, std::unique_ptr<Case>> cases;
  auto& made = cases[{state.range(0), state.range(1)}];
  if (!made) {
    const int size = static_cast<int>(state.range(1)), around = size > 100000 ? 200 : 20;
    made = std::make_unique<Case>(make_case(static_cast<geometry::Space>(state.range(0)), size / (2 * around), around));
    made->scene = prepare(made->placed);
  }
  return *made;
}

void prepare_room(benchmark::State& state) {
  const Case& c = case_of(state);
  for (auto _ : state) benchmark::DoNotOptimize(prepare(c.placed));
  state.counters["bytes/triangle"] =
      static_cast<double>(c.scene.objects->bytes()) / static_cast<double>(c.placed.parts[0].triangles.size());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(c.placed.parts[0].triangles.size()));
}

void camera_rays_meet(benchmark::State& state) {
  const Case& c = case_of(state);
  for (auto _ : state)
    for (const Ray& ray : c.rays) benchmark::DoNotOptimize(closest(c.scene, ray));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(c.rays.size()));
}

void paths_between_mirrors(benchmark::State& state) {
  const Case& c = case_of(state);
  std::int64_t pieces = 0;
  for (auto _ : state)
    for (const Ray& ray : c.rays) pieces += follow(c.scene, ray, {.max_bounces = 40}).bounces + 1;
  state.SetItemsProcessed(pieces);
}

void shadow_rays(benchmark::State& state) {
  const Case& c = case_of(state);
  for (auto _ : state)
    for (const Ray& ray : c.rays) benchmark::DoNotOptimize(occluded(c.scene, ray, 0.9));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(c.rays.size()));
}

void sizes(benchmark::internal::Benchmark* b) {
  b->Unit(benchmark::kMillisecond)->ArgNames({"curvature", "triangles"});
  for (const int size : {12500, 1000000})
    for (const int k : {-1, 0, 1}) b->Args({k, size});
}

BENCHMARK(prepare_room)->Apply(sizes);
BENCHMARK(camera_rays_meet)->Apply(sizes);
BENCHMARK(paths_between_mirrors)->Apply(sizes);
BENCHMARK(shadow_rays)->Apply(sizes);

}  // namespace

BENCHMARK_MAIN();
