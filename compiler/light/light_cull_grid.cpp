#include "compiler/light/light_cull_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "compiler/base/elementary.h"
#include "compiler/geometry/chart.h"
#include "compiler/light/lighting.h"

namespace orbc::light {
namespace {

using geometry::Space;

constexpr int kCellsAcross = 12, kCellsUp = 4;
constexpr std::size_t kMaxImagesForFlatList = 8;  // images: testing all of them costs no more than the lookup

int cell_of(double at, int cells) { return at > 0 ? static_cast<int>(std::min(at * cells, cells - 1.0)) : 0; }

}  // namespace

LightCullGrid make_light_cull_grid(const LightingContext& lighting, const Executor& executor) {
  LightCullGrid grid;
  const Space space = lighting.scene.prism.space;
  if (lighting.lamps->images.size() <= kMaxImagesForFlatList || space == Space::spherical) {
    grid.images[0].resize(lighting.lamps->images.size());
    std::iota(grid.images[0].begin(), grid.images[0].end(), 0u);
    return grid;
  }
  const place::Interior& interior = *lighting.scene.interior;
  grid.height = interior.height;
  grid.cells_across = kCellsAcross;
  grid.cells_up = kCellsUp;
  for (const geometry::Point& p : interior.polygon.outline)
    grid.disk_radius = std::max(grid.disk_radius, math::abs(geometry::disk_from_point(space, p)));
  grid.images.resize(static_cast<std::size_t>(kCellsAcross) * kCellsAcross * kCellsUp);
  executor(grid.images.size(), [&](std::size_t cell) {
    const auto number = static_cast<int>(cell);
    const int i = number % kCellsAcross, j = number / kCellsAcross % kCellsAcross, k = number / kCellsAcross / kCellsAcross;
    const double size = 2 * grid.disk_radius / kCellsAcross, half = size / std::numbers::sqrt2;
    const std::complex<double> middle(-grid.disk_radius + (i + 0.5) * size, -grid.disk_radius + (j + 0.5) * size);
    const double outer = std::min(grid.disk_radius, math::abs(middle) + half);
    if (math::abs(middle) - half > grid.disk_radius) return;  // the cell lies outside of the room
    // Lengths in the disk chart of H² are at most 2/(1 − ρ²) times the Euclidean ones, and geodesics between points of the room stay in the
    // circle around it.
    const std::complex<double> centre = math::abs(middle) > grid.disk_radius ? grid.disk_radius / math::abs(middle) * middle : middle;
    const double stretch = space == Space::euclidean ? 1 : 2 / std::max(1e-9, 1 - outer * outer);
    const double rise = grid.height / kCellsUp;
    const geometry::Position at{geometry::point_from_disk(space, centre), (k + 0.5) * rise};
    const double radius = math::hypot((half + math::abs(middle - centre)) * stretch, rise / 2);
    grid.images[cell] = images_within(lighting, at, radius, 1 / std::numbers::pi);
  });
  return grid;
}

const std::vector<std::uint32_t>& images_at(const LightingContext& lighting, const geometry::Position& at) {
  const LightCullGrid& grid = lighting.cull_grid;
  if (grid.cells_across == 0) return grid.images.front();
  const std::complex<double> z = geometry::disk_from_point(lighting.scene.prism.space, at.floor);
  const int i = cell_of((z.real() / grid.disk_radius + 1) / 2, grid.cells_across),
            j = cell_of((z.imag() / grid.disk_radius + 1) / 2, grid.cells_across), k = cell_of(at.z / grid.height, grid.cells_up);
  return grid.images[static_cast<std::size_t>((k * grid.cells_across + j) * grid.cells_across + i)];
}

}  // namespace orbc::light
