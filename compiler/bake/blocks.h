#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "compiler/surface/normals.h"

namespace orbc::bake {

/// Two neighbouring triangles of one look, or one, as a square of the atlas: corners 00, 10, 01 are those of `first`, 11 is the other one
/// of `second`.
struct Block {
  std::uint32_t part = 0;
  std::uint32_t first = 0;
  int second = -1;                          ///< −1: a single triangle
  std::array<int, 3> turn{0, 1, 2};         ///< which corners of `first` stand at 00, 10, 01
  std::array<int, 3> second_turn{0, 1, 2};  ///< which of `second` stand at 11, 01, 10
  double length_u = 0, length_v = 0;        ///< of its sides
};

/// Pairs the triangles of a part: across their longest edge where light may be interpolated over it (same look, same normals at its ends).
[[nodiscard]] std::vector<Block> blocks_of(const place::PlacedRoom& room, std::uint32_t part, const surface::PartNormals& normals);

/// Where (u, v) of the square lies: the triangle and its barycentric coordinates, in the triangle's own order.
struct InTriangle {
  std::size_t triangle = 0;
  std::array<double, 3> b{};
};
[[nodiscard]] InTriangle in_triangle(const Block& block, double u, double v);
/// The same, moved by this share of the way to the block's middle.
[[nodiscard]] inline InTriangle within_block(const Block& block, double u, double v, double share) {
  const double middle = block.second < 0 ? 1.0 / 3 : 0.5;
  return in_triangle(block, u + share * (middle - u), v + share * (middle - v));
}

/// Whether (u, v) of the square lies in a hole of its triangle (Look::cutoff); beyond the long side of a single triangle as the point of
/// that side nearest to it.
[[nodiscard]] bool in_hole(const place::PlacedRoom& room, const Block& block, double u, double v);
/// Whether the point (i, j) of a grid of w × h points from corner to corner lies on the block: a single triangle has only half of them.
[[nodiscard]] inline bool on_block(const Block& block, int i, int j, int w, int h) {
  return block.second >= 0 ||
         static_cast<std::int64_t>(i) * (h - 1) + static_cast<std::int64_t>(j) * (w - 1) <= static_cast<std::int64_t>(w - 1) * (h - 1);
}

/// A rectangle to be packed.
struct Box {
  int width = 0, height = 0, x = 0, y = 0;
};
/// Packs by shelves, tallest first, into a picture whose width is a power of two. Makes: its size, or nothing if it would exceed max_side.
[[nodiscard]] std::optional<std::array<int, 2>> pack(std::vector<Box>& boxes, int max_side);

}  // namespace orbc::bake
