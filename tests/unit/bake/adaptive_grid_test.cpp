#include "compiler/bake/adaptive_grid.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

using namespace orbc;
using bake::AdaptiveGrid;
using bake::GridLevels;
using bake::GridPoint;
using bake::GridSample;
using bake::TexelPatch;

namespace {

/// A grey function of (u, v); differences are those of its values.
struct GreySampler {
  std::function<double(double, double)> value;
  std::function<bool(double, double)> is_excluded = [](double, double) { return false; };
  int samples = 0;

  GridSample sample(const GridPoint& at) {
    ++samples;
    const double grey = value(at.u(), at.v());
    return {{grey, grey, grey}, is_excluded(at.u(), at.v())};
  }
  [[nodiscard]] double difference(const scene::Color& a, const scene::Color& b) const { return std::fabs(a.r - b.r); }
};

TexelPatch pair() {
  TexelPatch patch;
  patch.second = 1;
  return patch;
}

AdaptiveGrid sampled(const TexelPatch& patch, const GridLevels& levels, GreySampler& sampler) {
  const auto coarse = bake::sample_coarse_grid(patch, levels, sampler);
  return bake::refine_grid(patch, levels, coarse, {0.1, 0.01}, sampler);
}

}  // namespace

TEST_CASE("even light is sampled on the coarse grid alone, and interpolated exactly in between", "[bake]") {
  const GridLevels levels{2, 2, 5, 5};
  for (const bool single : {false, true}) {
    const TexelPatch patch = single ? TexelPatch{} : pair();
    GreySampler sampler{[](double u, double v) { return 0.2 + 0.1 * u + 0.05 * v; }};
    const AdaptiveGrid grid = sampled(patch, levels, sampler);
    CHECK(grid.width == 33);
    CHECK(grid.height == 33);
    CHECK(sampler.samples == (single ? 15 : 25));
    CHECK(grid.sampled.u == 8);
    CHECK(grid.sampled.v == 8);
    for (int j = 0; j < grid.height; ++j)
      for (int i = 0; i < grid.width; ++i)
        if (bake::on_patch(patch, i, j, grid.width, grid.height))
          CHECK(grid.color[grid.index(i, j)].r == Approx(0.2 + 0.1 * i / 32.0 + 0.05 * j / 32.0));
  }
}

TEST_CASE("a border of a shadow is sampled down to the finest step, and little else is", "[bake]") {
  GreySampler sampler{[](double u, double v) { return u + 0.3 * v > 0.61 ? 1.0 : 0.0; }};
  const AdaptiveGrid grid = sampled(pair(), {3, 3, 7, 7}, sampler);
  int wrong = 0;
  for (int j = 0; j < grid.height; ++j)
    for (int i = 0; i < grid.width; ++i) {
      const GridPoint at{i, j, grid.width, grid.height};
      wrong += grid.color[grid.index(i, j)].r != sampler.value(at.u(), at.v());
    }
  CHECK(wrong == 0);
  CHECK(grid.sampled.u == 1);
  CHECK(sampler.samples < grid.width * grid.height / 4);
}

TEST_CASE("points without light of their own take on that of their neighbours, as far as there are any", "[bake]") {
  GreySampler sampler{[](double u, double) { return u < 0.5 ? 0.0 : 0.7; }, [](double u, double) { return u < 0.5; }};
  AdaptiveGrid grid = sampled(pair(), {2, 2, 4, 4}, sampler);
  CHECK(grid.excluded[grid.index(0, 0)] == 1);
  grid = bake::inpaint_excluded(grid, pair(), {1, 1});
  for (const scene::Color& c : grid.color) CHECK(c.r == Approx(0.7));
  GreySampler dark{[](double, double) { return 0.0; }, [](double, double) { return true; }};
  const AdaptiveGrid closed = bake::inpaint_excluded(sampled(pair(), {1, 1, 3, 3}, dark), pair(), {1, 1});
  for (const std::uint8_t excluded : closed.excluded) CHECK(excluded == 1);
}
