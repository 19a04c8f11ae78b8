#include "compiler/bake/irradiance_grid.h"

#include <algorithm>

namespace orbc::bake {

scene::Color interpolate(const IrradianceGrid& grid, double u, double v) {
  const double x = std::clamp(u, 0.0, 1.0) * (grid.width - 1), y = std::clamp(v, 0.0, 1.0) * (grid.height - 1);
  const int i = std::min(static_cast<int>(x), grid.width - 2), j = std::min(static_cast<int>(y), grid.height - 2);
  const double s = x - i, t = y - j;
  const auto &a = grid.point(i, j), &b = grid.point(i + 1, j), &c = grid.point(i, j + 1), &d = grid.point(i + 1, j + 1);
  const auto channel = [&](std::size_t k) { return (1 - t) * ((1 - s) * a[k] + s * b[k]) + t * ((1 - s) * c[k] + s * d[k]); };
  return {channel(0), channel(1), channel(2)};
}

IrradianceGrid extrapolate_beyond_patch(IrradianceGrid grid, const TexelPatch& patch) {
  for (int j = 0; j < grid.height; ++j)
    for (int i = 0; i < grid.width; ++i) {
      if (on_patch(patch, i, j, grid.width, grid.height)) continue;
      for (std::size_t c = 0; c < 3; ++c)
        grid.point(i, j)[c] = std::max(0.0f, grid.point(i - 1, j)[c] + grid.point(i, j - 1)[c] - grid.point(i - 1, j - 1)[c]);
    }
  return grid;
}

}  // namespace orbc::bake
