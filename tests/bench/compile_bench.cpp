// Compiling one prepared scene for its first eye, which prepares it, and for a second: what an animation takes a frame.
#include <benchmark/benchmark.h>

#include "compiler/driver/compile.h"

using namespace orbc;

namespace {

const driver::LoadedScene& loaded() {
  static const driver::LoadedScene scene =
      driver::load(ORBC_SOURCE_DIR "/tests/bench/lit.yaml", {{"<bench>", "bake.quality=draft"}}).value();
  return scene;
}

void compile(const driver::PreparedScene& scene) {
  benchmark::DoNotOptimize(driver::compile(scene, loaded().eye, {}, serial_executor()).value().product.indices.size());
}

void first_eye(benchmark::State& state) {
  for (auto _ : state) compile(driver::PreparedScene(loaded()));
}

void second_eye(benchmark::State& state) {
  const driver::PreparedScene scene(loaded());
  compile(scene);
  for (auto _ : state) compile(scene);
}

BENCHMARK(first_eye)->Unit(benchmark::kMillisecond);
BENCHMARK(second_eye)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
