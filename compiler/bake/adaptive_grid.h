#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "compiler/bake/patches.h"
#include "compiler/scene/color.h"

namespace orbc::bake {

// Adaptive sampling of a patch on a regular grid from corner to corner. The grid has 2^n + 1 points a side. Sampling starts with a coarse
// step. Then the step is halved until it is one point; each new point is either interpolated from the points around it or sampled.

/// The number of halvings of the two sides of a patch: where sampling starts, and where it ends. coarse ≤ fine.
struct GridLevels {
  int coarse_u = 0, coarse_v = 0;
  int fine_u = 0, fine_v = 0;
  [[nodiscard]] int width() const { return (1 << fine_u) + 1; }
  [[nodiscard]] int height() const { return (1 << fine_v) + 1; }
};

/// Distance between neighbouring points, in points of the finest grid.
struct GridStep {
  int u = 1, v = 1;
};
[[nodiscard]] inline GridStep coarse_step(const GridLevels& levels) {
  return {1 << (levels.fine_u - levels.coarse_u), 1 << (levels.fine_v - levels.coarse_v)};
}

/// A point of a grid of `width` × `height` points.
struct GridPoint {
  int i = 0, j = 0;
  int width = 2, height = 2;
  [[nodiscard]] double u() const { return static_cast<double>(i) / (width - 1); }
  [[nodiscard]] double v() const { return static_cast<double>(j) / (height - 1); }
  [[nodiscard]] bool is_corner() const { return (i == 0 || i == width - 1) && (j == 0 || j == height - 1); }
};

struct GridSample {
  scene::Color color;
  bool excluded = false;  ///< the point has no colour of its own: interpolation leaves it out
};

/// Where a point is sampled instead of interpolated. Differences are those of the sampler.
struct RefinementLimits {
  double max_step = 0;  ///< between two opposite neighbours
  double tolerance =
      0;  ///< between a sample and the interpolated value: beyond it the neighbourhood is rough, and sampled at the next step
  double rough_tolerance = 0;  ///< the same beyond which a point counts as AdaptiveGrid::rough
};

/// Colours at the points of a grid, row by row.
struct ColorGrid {
  int width = 2, height = 2;
  std::vector<scene::Color> color;

  [[nodiscard]] std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i);
  }
};

/// All points of the finest grid.
struct AdaptiveGrid : ColorGrid {
  std::vector<std::uint8_t> excluded;  ///< 1: as GridSample::excluded
  std::vector<std::uint8_t> rough;     ///< 1: at the finest step this point was not what its neighbours let expect
  GridStep sampled;                    ///< the smallest step at which a point was sampled: between them all points are interpolated
};

/// The points around a new point from which it is interpolated: opposite pairs, the first `count` of them.
struct GridParents {
  std::array<std::size_t, 4> index{};
  std::size_t count = 2;
};
/// In: a point of the grid that the step `coarse` does not reach.
[[nodiscard]] inline GridParents parents_of(const AdaptiveGrid& grid, const TexelPatch& patch, int i, int j, const GridStep& coarse) {
  const bool between_u = i % coarse.u != 0, between_v = j % coarse.v != 0;
  const int i0 = i - i % coarse.u, i1 = between_u ? i0 + coarse.u : i0;
  const int j0 = j - j % coarse.v, j1 = between_v ? j0 + coarse.v : j0;
  if (!between_u || !between_v) return {{grid.index(i0, j0), grid.index(i1, j1)}, 2};
  // In the middle of a cell; across the long side of a single triangle there is only one diagonal.
  const std::size_t count = on_patch(patch, i1, j1, grid.width, grid.height) ? 4 : 2;
  return {{grid.index(i0, j1), grid.index(i1, j0), grid.index(i0, j0), grid.index(i1, j1)}, count};
}

/// The mean of those parents that are not excluded; excluded if all of them are.
[[nodiscard]] inline GridSample interpolate(const AdaptiveGrid& grid, const GridParents& parents) {
  scene::Color sum;
  int count = 0;
  for (std::size_t k = 0; k < parents.count; ++k) {
    if (grid.excluded[parents.index[k]]) continue;
    sum = sum + grid.color[parents.index[k]];
    ++count;
  }
  return count > 0 ? GridSample{(1.0 / count) * sum, false} : GridSample{{}, true};
}

/// Whether a point has to be sampled: one of its parents is rough, some but not all are excluded, or two opposite ones differ too much.
template <class Sampler>
[[nodiscard]] bool needs_sample(const AdaptiveGrid& grid, const GridParents& parents, const std::vector<std::uint8_t>& rough,
                                double max_step, const Sampler& sampler) {
  std::size_t excluded = 0;
  for (std::size_t k = 0; k < parents.count; ++k) {
    if (rough[parents.index[k]]) return true;
    excluded += grid.excluded[parents.index[k]];
  }
  if (excluded > 0 && excluded < parents.count) return true;
  for (std::size_t k = 0; k < parents.count; k += 2)
    if (sampler.difference(grid.color[parents.index[k]], grid.color[parents.index[k + 1]]) > max_step) return true;
  return false;
}

/// Samples the coarse grid. Makes: its points row by row; those that do not lie on the patch are black.
/// In: Sampler has GridSample sample(const GridPoint&), and double difference(const Color&, const Color&) const.
template <class Sampler>
[[nodiscard]] std::vector<GridSample> sample_coarse_grid(const TexelPatch& patch, const GridLevels& levels, Sampler& sampler) {
  const int width = levels.width(), height = levels.height();
  const GridStep step = coarse_step(levels);
  std::vector<GridSample> samples;
  for (int j = 0; j < height; j += step.v)
    for (int i = 0; i < width; i += step.u)
      samples.push_back(on_patch(patch, i, j, width, height) ? sampler.sample({i, j, width, height}) : GridSample{});
  return samples;
}

/// A new point. Samplers that want to know the points between which it lies have sample(const GridPoint&, const GridParents&).
template <class Sampler>
[[nodiscard]] GridSample sample_between(Sampler& sampler, const GridPoint& at, const GridParents& parents) {
  if constexpr (requires { sampler.sample(at, parents); }) return sampler.sample(at, parents);
  else return sampler.sample(at);
}

/// The finest grid with the coarse samples in their places, all other points black.
[[nodiscard]] AdaptiveGrid spread_samples(const GridLevels& levels, const std::vector<GridSample>& coarse);

/// Fills the finest grid from the samples of the coarse one.
/// Source: Whitted, An improved illumination model for shaded display, 1980, §4, on the points of a patch instead of pixels.
/// Not promised: what lies between points of the coarse grid and shows at none of them is missed.
template <class Sampler>
[[nodiscard]] AdaptiveGrid refine_grid(const TexelPatch& patch, const GridLevels& levels, const std::vector<GridSample>& coarse,
                                       const RefinementLimits& limits, Sampler& sampler) {
  AdaptiveGrid grid = spread_samples(levels, coarse);
  std::vector<std::uint8_t> rough(grid.color.size(), 0);
  GridStep from = coarse_step(levels);
  while (from.u > 1 || from.v > 1) {
    const GridStep to{std::max(1, from.u / 2), std::max(1, from.v / 2)};
    const bool is_finest = to.u == 1 && to.v == 1;
    std::vector<std::uint8_t> next_rough(rough.size(), 0);
    for (int j = 0; j < grid.height; j += to.v)
      for (int i = 0; i < grid.width; i += to.u) {
        if ((i % from.u == 0 && j % from.v == 0) || !on_patch(patch, i, j, grid.width, grid.height)) continue;
        const std::size_t at = grid.index(i, j);
        const GridParents parents = parents_of(grid, patch, i, j, from);
        GridSample value = interpolate(grid, parents);
        if (needs_sample(grid, parents, rough, limits.max_step, sampler)) {
          const GridSample sample = sample_between(sampler, {i, j, grid.width, grid.height}, parents);
          grid.sampled = to;
          const double off = sample.excluded ? 0 : sampler.difference(sample.color, value.color);
          if (is_finest) grid.rough[at] = off > limits.rough_tolerance;
          if (off > limits.tolerance) {
            next_rough[at] = 1;
            for (std::size_t k = 0; k < parents.count; ++k) next_rough[parents.index[k]] = 1;
          }
          value = sample;
        }
        grid.color[at] = value.color;
        grid.excluded[at] = value.excluded;
      }
    rough = std::move(next_rough);
    from = to;
  }
  return grid;
}

/// The colour of a point beyond the long side of a single triangle: c₁ + c₂ − c₀ of the three points before it, at least black, so that
/// look-ups are linear up to that side.
[[nodiscard]] scene::Color extrapolate_beyond_patch(const ColorGrid& grid, int i, int j);

/// Excluded points take on the mean of their neighbours at this step, ring by ring, until none can be reached.
[[nodiscard]] AdaptiveGrid inpaint_excluded(AdaptiveGrid grid, const TexelPatch& patch, const GridStep& step);

}  // namespace orbc::bake
