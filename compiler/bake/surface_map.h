#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "compiler/bake/blocks.h"
#include "compiler/trace/follow.h"

namespace orbc::bake {

/// A place on a block.
struct OnBlock {
  int block = -1;  ///< of all blocks of the room, in the order of its parts; −1: no block there
  float u = 0, v = 0;
};

/// Finds the block on which a ray has ended. Floor, ceiling and walls are met by formula, so their triangles are looked up here.
class SurfaceMap {
 public:
  /// In: the blocks of every part, or of the first ones: rays end on those alone.
  SurfaceMap(const place::PlacedRoom& room, const std::vector<std::vector<Block>>& blocks);
  [[nodiscard]] OnBlock find(const trace::SurfacePoint& point, const trace::Hit& hit) const;
  /// The block on which a point of a stand-in has its light: that of the triangle where it lies on the surface, if the two look alike.
  [[nodiscard]] OnBlock stood_for(const trace::Hit& hit, std::uint16_t look) const;

 private:
  /// The triangles of a floor, ceiling or wall over a grid of cells of two coordinates.
  struct Chart {
    double low[2] = {0, 0}, size[2] = {1, 1};
    int cells = 1;
    std::vector<std::vector<std::uint32_t>> triangles;  ///< per cell
  };
  [[nodiscard]] std::array<double, 2> cell_coordinates(const place::PlacedMesh& part, const geometry::Point& at, double z) const;
  [[nodiscard]] std::array<double, 3> barycentric(const place::PlacedMesh& part, const mesh::Triangle& t, const geometry::Point& at,
                                                  double z) const;
  [[nodiscard]] static int cell_of(const Chart& chart, int c, double at, double shift);
  [[nodiscard]] Chart chart_of(const place::PlacedMesh& part) const;
  [[nodiscard]] OnBlock on_triangle(std::size_t part, std::size_t triangle, const std::array<double, 3>& b) const;
  [[nodiscard]] OnBlock on_flat(std::size_t part, const trace::SurfacePoint& point) const;

  const place::PlacedRoom& room_;
  std::vector<std::vector<std::uint32_t>> block_of_;  ///< [part][triangle], of all blocks
  std::vector<const Block*> blocks_;
  std::vector<Chart> charts_;                    ///< per part; empty for objects and frames
  std::vector<std::vector<std::size_t>> flats_;  ///< parts of floor, ceiling, wall 0, wall 1, …
};

}  // namespace orbc::bake
