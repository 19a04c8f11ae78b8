#include "compiler/mesh/weld.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace orbc::mesh {
namespace {

bool less(const geometry::Vector3& a, const geometry::Vector3& b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

}  // namespace

std::vector<std::uint32_t> weld_positions(const std::vector<geometry::Vector3>& positions) {
  std::vector<std::uint32_t> order(positions.size()), first(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (less(positions[a], positions[b])) return true;
    if (less(positions[b], positions[a])) return false;
    return a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && !less(positions[order[i - 1]], positions[order[i]]);
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

CompactMesh remove_unused_vertices(Mesh mesh) {
  constexpr std::uint32_t kUnused = 0xffffffff;
  std::vector<std::uint32_t> index(mesh.positions.size(), kUnused);
  for (const auto& t : mesh.triangles) {
    for (const auto v : t) index[v] = 0;
  }
  std::uint32_t next = 0;
  std::vector<std::uint32_t> origin;
  for (std::size_t v = 0; v < index.size(); ++v) {
    if (index[v] == kUnused) continue;
    mesh.positions[next] = mesh.positions[v];
    if (!mesh.uv.empty()) mesh.uv[next] = mesh.uv[v];
    if (!mesh.colors.empty()) mesh.colors[next] = mesh.colors[v];
    index[v] = next++;
    origin.push_back(static_cast<std::uint32_t>(v));
  }
  mesh.positions.resize(next);
  if (!mesh.uv.empty()) mesh.uv.resize(next);
  if (!mesh.colors.empty()) mesh.colors.resize(next);
  for (auto& t : mesh.triangles) t = {index[t[0]], index[t[1]], index[t[2]]};
  return {std::move(mesh), std::move(origin)};
}

}  // namespace orbc::mesh
