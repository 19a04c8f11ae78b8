#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compiler/bake/patches.h"
#include "compiler/trace/follow.h"

namespace orbc::bake {

/// A point of a patch.
struct PatchUv {
  int patch = -1;  ///< among all patches of the locator, in the order of the parts; −1: there is no patch
  float u = 0, v = 0;
};

/// Finds the patch on which a ray has ended. A ray meets floor, ceiling and walls by formula and not by triangles, so the locator keeps
/// their triangles in grids of cells. It refers to the room and to the patches.
class PatchLocator {
 public:
  /// In: the patches of the first parts of the room, part by part; rays end on those parts alone.
  PatchLocator(const place::Interior& interior, std::span<const std::vector<TexelPatch>> patches);
  /// The patch at the point where a ray has ended.
  [[nodiscard]] PatchUv find(const trace::SurfacePoint& point, const trace::Hit& hit) const;
  /// The patch from which a point of a level of detail takes over its light.
  /// In: the nearest triangle of the surface itself (light::project_to_surface), and the style that both must have.
  [[nodiscard]] PatchUv find_for_lod(const trace::Hit& hit, std::uint16_t style) const;

 private:
  /// The triangles of a floor, ceiling or wall in a square grid of cells of two coordinates.
  struct CellGrid {
    double low[2] = {0, 0}, size[2] = {1, 1};           ///< where the first cell begins, and the extent of a cell
    int cells = 1;                                      ///< a side
    std::vector<std::vector<std::uint32_t>> triangles;  ///< per cell
  };
  [[nodiscard]] std::array<double, 2> cell_coordinates(const place::PlacedMesh& part, const geometry::Point& at, double z) const;
  [[nodiscard]] std::array<double, 3> barycentric(const place::PlacedMesh& part, const mesh::Triangle& t, const geometry::Point& at,
                                                  double z) const;
  [[nodiscard]] static int cell_of(const CellGrid& grid, int c, double at, double shift);
  [[nodiscard]] CellGrid make_cell_grid(const place::PlacedMesh& part) const;
  [[nodiscard]] PatchUv on_triangle(std::size_t part, std::size_t triangle, const std::array<double, 3>& b) const;
  [[nodiscard]] PatchUv find_on_shell(std::size_t part, const trace::SurfacePoint& point) const;

  const place::Interior& interior_;
  std::vector<std::vector<std::uint32_t>> patch_of_triangle_;  ///< [part][triangle], of all patches
  std::vector<const TexelPatch*> patches_;
  std::vector<CellGrid> cell_grids_;                   ///< per part; empty for objects and frames
  std::vector<std::vector<std::size_t>> shell_parts_;  ///< parts of floor, ceiling, wall 0, wall 1, …
};

}  // namespace orbc::bake
