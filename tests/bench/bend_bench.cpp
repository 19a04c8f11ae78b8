// The bending kernel beside memcpy of its output, in one run: 166 copies × 13,013 vertices (the paper's scene has 166 copies of 26,022
// primitives). Ratios count, not times: items_per_second of bend / memcpy should be ≥ 0.4.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <thread>
#include <vector>

#include "compiler/bend/log_map.h"
#include "tests/unit/bend/fixture.h"

namespace {

using namespace orbc;
using geometry::Space;

constexpr std::size_t kVertices = 13013, kCopies = 166;

bend::PointColumns knot(Space space) {
  bend::PointColumns points;
  for (std::size_t i = 0; i < kVertices; ++i) {
    const double t = 2 * std::numbers::pi * static_cast<double>(i) / kVertices, s = 97 * t;
    const double r = 0.3 + 0.1 * std::cos(3 * t) + 0.03 * std::cos(s), phi = 2 * t;
    points.w.push_back(geometry::cos_k(space, r));
    points.x.push_back(geometry::sin_k(space, r) * std::cos(phi));
    points.y.push_back(geometry::sin_k(space, r) * std::sin(phi));
    points.z.push_back(static_cast<float>(0.5 + 0.1 * std::sin(3 * t) + 0.03 * std::sin(s)));
  }
  return points;
}

std::vector<bend::LogMap> maps(Space space) {
  std::vector<bend::LogMap> all;
  for (std::size_t i = 0; i < kCopies; ++i) {
    const double angle = 2.399963 * static_cast<double>(i), far = (space == Space::spherical ? 2.5 : 4.5) * std::sqrt((i + 0.5) / kCopies);
    all.push_back({space, geometry::matrix(geometry::translation_by(space, far * std::cos(angle), far * std::sin(angle))), 0});
  }
  return all;
}

using Kernel = void (*)(const bend::LogMap&, const bend::PointColumns&, std::size_t, std::size_t, float*);

void run(benchmark::State& state, Kernel kernel, Space space) {
  const auto points = knot(space);
  const auto copies = maps(space);
  std::vector<float> out(3 * kVertices * kCopies);
  for (auto _ : state) {
    for (std::size_t i = 0; i < kCopies; ++i) kernel(copies[i], points, 0, kVertices, out.data() + 3 * kVertices * i);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * kVertices * kCopies));
}

void copy_memory(benchmark::State& state) {
  const std::vector<float> from(3 * kVertices * kCopies, 1.5F);
  std::vector<float> out(from.size());
  for (auto _ : state) {
    std::memcpy(out.data(), from.data(), from.size() * sizeof(float));
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * kVertices * kCopies));
}

/// The whole of bend(): 166 copies of `*22222` with floor, ceiling, beams and a knot of 26,016 triangles; count, split, map, write.
void whole_cover(benchmark::State& state) {
  bend::test::Furnishing with;
  with.floor_cells = 4;
  with.knot_along = 813;
  with.knot_around = 16;
  const auto room = bend::test::regular_room(5, 2, with);
  const auto copies = bend::test::copies_of(room, 4);
  const auto uv = bend::test::plain_uv(room);
  const auto eye = bend::test::eye_at(room.polygon.space, 0.35, 2.9, 0.45, -0.2, -0.05);
  const auto threads = static_cast<std::size_t>(state.range(0));
  const Executor executor = [threads](std::size_t count, const std::function<void(std::size_t)>& task) {
    std::vector<std::thread> all;
    for (std::size_t t = 0; t < threads; ++t) {
      all.emplace_back([=, &task] {
        for (std::size_t i = t; i < count; i += threads) task(i);
      });
    }
    for (auto& thread : all) thread.join();
  };
  std::size_t triangles = 0;
  for (auto _ : state) {
    const auto cover = bend::test::bend_whole(room, uv, copies, eye, {}, executor);
    triangles = cover->indices.size() / 3;
    benchmark::DoNotOptimize(cover->positions.data());
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * triangles));
}

BENCHMARK(copy_memory);
BENCHMARK_CAPTURE(run, bend_points_hyperbolic, bend::bend_points, Space::hyperbolic);
BENCHMARK_CAPTURE(run, bend_points_spherical, bend::bend_points, Space::spherical);
BENCHMARK_CAPTURE(run, bend_points_euclidean, bend::bend_points, Space::euclidean);
BENCHMARK_CAPTURE(run, bend_points_scalar_hyperbolic, bend::bend_points_scalar, Space::hyperbolic);
BENCHMARK_CAPTURE(run, bend_points_scalar_spherical, bend::bend_points_scalar, Space::spherical);
BENCHMARK(whole_cover)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
