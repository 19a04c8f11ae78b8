#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "compiler/scene/color.h"

namespace orbc::bake {

/// Light on a block: a grid of points from corner to corner, read by interpolation.
struct LightGrid {
  int w = 2, h = 2;  ///< points, at least 2 each
  std::vector<std::array<float, 3>> light = std::vector<std::array<float, 3>>(4);
  std::uint64_t asked = 0;  ///< points that were lit for it

  [[nodiscard]] std::array<float, 3>& point(int i, int j) {
    return light[static_cast<std::size_t>(j) * static_cast<std::size_t>(w) + static_cast<std::size_t>(i)];
  }
  [[nodiscard]] const std::array<float, 3>& point(int i, int j) const {
    return light[static_cast<std::size_t>(j) * static_cast<std::size_t>(w) + static_cast<std::size_t>(i)];
  }
};

/// In: u, v in [0, 1] from corner 00.
[[nodiscard]] inline scene::Color light_at(const LightGrid& grid, double u, double v) {
  const double x = std::clamp(u, 0.0, 1.0) * (grid.w - 1), y = std::clamp(v, 0.0, 1.0) * (grid.h - 1);
  const int i = std::min(static_cast<int>(x), grid.w - 2), j = std::min(static_cast<int>(y), grid.h - 2);
  const double s = x - i, t = y - j;
  const auto &a = grid.point(i, j), &b = grid.point(i + 1, j), &c = grid.point(i, j + 1), &d = grid.point(i + 1, j + 1);
  const auto channel = [&](std::size_t k) { return (1 - t) * ((1 - s) * a[k] + s * b[k]) + t * ((1 - s) * c[k] + s * d[k]); };
  return {channel(0), channel(1), channel(2)};
}

}  // namespace orbc::bake
