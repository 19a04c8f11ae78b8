#include "compiler/bake/blocks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "compiler/base/elementary.h"
#include "compiler/place/texel.h"

namespace orbc::bake {
namespace {

using place::PlacedMesh;

double edge_length(geometry::Space space, const PlacedMesh& mesh, std::uint32_t a, std::uint32_t b) {
  return math::hypot(geometry::distance(space, mesh.floor[a], mesh.floor[b]), mesh.z[a] - mesh.z[b]);
}

/// Edges by their two ends: who has them.
struct EdgeUse {
  std::uint32_t low, high, triangle;
  int k;  ///< from corner k to k + 1
};

std::vector<EdgeUse> edges_of(const PlacedMesh& mesh) {
  std::vector<EdgeUse> edges;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), t, k});
    }
  std::sort(edges.begin(), edges.end(),
            [](const EdgeUse& a, const EdgeUse& b) { return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle); });
  return edges;
}

}  // namespace

std::vector<Block> blocks_of(const place::PlacedRoom& room, std::uint32_t part, const surface::PartNormals& normals) {
  const PlacedMesh& mesh = room.parts[part];
  const geometry::Space space = room.room.space;
  // other[t][k]: the triangle across edge k and the number of the edge there.
  std::vector<std::array<std::array<int, 2>, 3>> other(mesh.triangles.size(), {{{-1, 0}, {-1, 0}, {-1, 0}}});
  const std::vector<EdgeUse> edges = edges_of(mesh);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const EdgeUse &a = edges[i], &b = edges[i + 1];
    if (a.low != b.low || a.high != b.high || a.triangle == b.triangle) continue;
    other[a.triangle][a.k] = {static_cast<int>(b.triangle), b.k};
    other[b.triangle][b.k] = {static_cast<int>(a.triangle), a.k};
    ++i;
  }
  std::vector<bool> taken(mesh.triangles.size(), false);
  std::vector<Block> blocks;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (taken[t]) continue;
    taken[t] = true;
    const mesh::Triangle& own = mesh.triangles[t];
    std::array<double, 3> length{};
    for (int k = 0; k < 3; ++k) length[k] = edge_length(space, mesh, own[k], own[(k + 1) % 3]);
    const int k = static_cast<int>(std::max_element(length.begin(), length.end()) - length.begin());
    Block block;
    block.part = part, block.first = t;
    block.turn = {(k + 2) % 3, k, (k + 1) % 3};
    block.length_u = length[(k + 2) % 3], block.length_v = length[(k + 1) % 3];
    const auto [s, m] = other[t][k];
    const auto& corners = normals.corners;
    // The neighbour runs along the common edge the other way round.
    const bool smooth = s >= 0 && !taken[s] && mesh.look[s] == mesh.look[t] && corners[s][m] == corners[t][(k + 1) % 3] &&
                        corners[s][(m + 1) % 3] == corners[t][k];
    if (smooth) {
      taken[s] = true;
      const mesh::Triangle& across = mesh.triangles[s];
      block.second = s;
      block.second_turn = {(m + 2) % 3, m, (m + 1) % 3};
      block.length_u = std::max(block.length_u, edge_length(space, mesh, across[m], across[(m + 2) % 3]));
      block.length_v = std::max(block.length_v, edge_length(space, mesh, across[(m + 1) % 3], across[(m + 2) % 3]));
    } else {
      block.length_u = block.length_v = std::max(block.length_u, block.length_v);
    }
    blocks.push_back(block);
  }
  return blocks;
}

InTriangle in_triangle(const Block& block, double u, double v) {
  InTriangle place;
  if (block.second < 0 || u + v <= 1) {
    place.triangle = block.first;
    place.b[block.turn[0]] = 1 - u - v, place.b[block.turn[1]] = u, place.b[block.turn[2]] = v;
    return place;
  }
  place.triangle = static_cast<std::size_t>(block.second);
  place.b[block.second_turn[0]] = u + v - 1, place.b[block.second_turn[1]] = 1 - u, place.b[block.second_turn[2]] = 1 - v;
  return place;
}

bool in_hole(const place::PlacedRoom& room, const Block& block, double u, double v) {
  if (block.second < 0 && u + v > 1) {
    u = std::clamp((1 + u - v) / 2, 0.0, 1.0);
    v = 1 - u;
  }
  const InTriangle at = in_triangle(block, u, v);
  return place::in_hole(room, room.parts[block.part], at.triangle, {at.b[0], at.b[1], at.b[2]});
}

std::optional<std::array<int, 2>> pack(std::vector<Box>& boxes, int max_side) {
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return boxes[a].height > boxes[b].height; });
  std::int64_t area = 0;
  int widest = 1;
  for (const Box& box : boxes) area += static_cast<std::int64_t>(box.width) * box.height, widest = std::max(widest, box.width);
  for (int width = 16; width <= max_side; width *= 2) {
    if (width < widest || (static_cast<std::int64_t>(width) * width < area && width * 2 <= max_side)) continue;
    std::int64_t y = 0, shelf = 0;
    int x = 0;
    for (const std::uint32_t i : order) {
      if (x + boxes[i].width > width) y += shelf, shelf = 0, x = 0;
      boxes[i].x = x, boxes[i].y = static_cast<int>(std::min<std::int64_t>(y, max_side));
      x += boxes[i].width;
      shelf = std::max<std::int64_t>(shelf, boxes[i].height);
    }
    const std::int64_t height = y + shelf;
    if (height > width && width * 2 <= max_side) continue;
    if (height > max_side) return std::nullopt;
    return std::array<int, 2>{width, static_cast<int>(std::max<std::int64_t>(height, 4))};
  }
  return std::nullopt;
}

}  // namespace orbc::bake
