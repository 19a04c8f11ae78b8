// Words per second of the stream of copies; memory does not depend on the count.
#include <benchmark/benchmark.h>

#include "compiler/cover/enumerate.h"
#include "compiler/notation/parse.h"
#include "compiler/room/realise.h"

using namespace orbc;

namespace {

void words(benchmark::State& state, const char* notation, int length) {
  const cover::Automaton automaton(*notation::parse(notation));
  std::int64_t count = 0;
  for (auto _ : state) {
    cover::enumerate(automaton, length, [&](const cover::Element& element) {
      benchmark::DoNotOptimize(element.descents);
      ++count;
      return true;
    });
  }
  state.SetItemsProcessed(count);
}

void words_with_isometries(benchmark::State& state, const char* notation, int length) {
  const auto orbifold = *notation::parse(notation);
  const cover::Automaton automaton(orbifold);
  const std::vector<geometry::Isometry> reflections = room::generators(*room::realise(orbifold));
  std::int64_t count = 0;
  for (auto _ : state) {
    cover::enumerate(automaton, reflections, length, [&](const cover::Element&, const geometry::Isometry& map) {
      benchmark::DoNotOptimize(map.a);
      ++count;
      return true;
    });
  }
  state.SetItemsProcessed(count);
}

}  // namespace

BENCHMARK_CAPTURE(words, pentagon, "*22222", 10);
BENCHMARK_CAPTURE(words, triangle_237, "*237", 60);
BENCHMARK_CAPTURE(words, decagon, "*23456789(10)(11)", 6);
BENCHMARK_CAPTURE(words_with_isometries, pentagon, "*22222", 10);
BENCHMARK_CAPTURE(words_with_isometries, triangle_237, "*237", 60);

BENCHMARK_MAIN();
