#include "compiler/bake/adaptive_grid.h"

#include <utility>

namespace orbc::bake {

AdaptiveGrid spread_samples(const GridLevels& levels, const std::vector<GridSample>& coarse) {
  AdaptiveGrid grid;
  grid.width = levels.width();
  grid.height = levels.height();
  grid.color.resize(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  grid.excluded.assign(grid.color.size(), 0);
  grid.rough.assign(grid.color.size(), 0);
  grid.sampled = coarse_step(levels);
  std::size_t next = 0;
  for (int j = 0; j < grid.height; j += grid.sampled.v)
    for (int i = 0; i < grid.width; i += grid.sampled.u) {
      const GridSample& sample = coarse[next++];
      grid.color[grid.index(i, j)] = sample.color;
      grid.excluded[grid.index(i, j)] = sample.excluded;
    }
  return grid;
}

scene::Color extrapolate_beyond_patch(const ColorGrid& grid, int i, int j) {
  const scene::Color a = grid.color[grid.index(i - 1, j)], b = grid.color[grid.index(i, j - 1)], c = grid.color[grid.index(i - 1, j - 1)];
  // Where colours above white change fast, what white would give keeps the picture, which ends at white, from turning black.
  const auto beyond = [](double p, double q, double r) {
    return std::max({0.0, p + q - r, std::min(p, 1.0) + std::min(q, 1.0) - std::min(r, 1.0)});
  };
  return {beyond(a.r, b.r, c.r), beyond(a.g, b.g, c.g), beyond(a.b, b.b, c.b)};
}

AdaptiveGrid inpaint_excluded(AdaptiveGrid grid, const TexelPatch& patch, const GridStep& step) {
  const auto is_on_patch = [&](int i, int j) {
    return i >= 0 && j >= 0 && i < grid.width && j < grid.height && on_patch(patch, i, j, grid.width, grid.height);
  };
  std::vector<std::array<int, 2>> excluded;
  for (int j = 0; j < grid.height; j += step.v)
    for (int i = 0; i < grid.width; i += step.u)
      if (is_on_patch(i, j) && grid.excluded[grid.index(i, j)]) excluded.push_back({i, j});
  while (!excluded.empty()) {
    std::vector<std::pair<std::size_t, scene::Color>> ring;
    std::vector<std::array<int, 2>> rest;
    for (const auto& [i, j] : excluded) {
      scene::Color sum;
      int count = 0;
      for (const auto& [x, y] :
           {std::array{i - step.u, j}, std::array{i + step.u, j}, std::array{i, j - step.v}, std::array{i, j + step.v}}) {
        if (!is_on_patch(x, y) || grid.excluded[grid.index(x, y)]) continue;
        sum = sum + grid.color[grid.index(x, y)];
        ++count;
      }
      if (count > 0) ring.push_back({grid.index(i, j), (1.0 / count) * sum});
      else rest.push_back({i, j});
    }
    if (ring.empty()) break;
    for (const auto& [at, color] : ring) {
      grid.color[at] = color;
      grid.excluded[at] = 0;
    }
    excluded = std::move(rest);
  }
  return grid;
}

}  // namespace orbc::bake
