#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "compiler/bake/patches.h"
#include "compiler/scene/color.h"

namespace orbc::bake {

/// Irradiance on a patch: a grid of points from corner to corner, row by row, interpolated in between.
struct IrradianceGrid {
  int width = 2, height = 2;  ///< points, at least 2 each
  std::vector<std::array<float, 3>> light = std::vector<std::array<float, 3>>(4);
  std::uint64_t lit_points = 0;  ///< points at which shadow rays were traced for it

  [[nodiscard]] std::array<float, 3>& point(int i, int j) {
    return light[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i)];
  }
  [[nodiscard]] const std::array<float, 3>& point(int i, int j) const {
    return light[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i)];
  }
};

/// The irradiance at (u, v) of the patch, bilinear; u and v are clamped to [0, 1].
[[nodiscard]] scene::Color interpolate(const IrradianceGrid& grid, double u, double v);

/// Continues the irradiance of a single triangle beyond its long side, c₁ + c₂ − c₀ but not below 0, so that interpolation is linear up to
/// that side. Grids of pairs stay as they are.
[[nodiscard]] IrradianceGrid extrapolate_beyond_patch(IrradianceGrid grid, const TexelPatch& patch);

}  // namespace orbc::bake
