#include "compiler/bake/patches.h"

#include <algorithm>
#include <cmath>

#include "compiler/base/elementary.h"
#include "compiler/place/alpha_mask.h"
#include "compiler/surface/albedo.h"

namespace orbc::bake {
namespace {

using place::PlacedMesh;

/// Rounded, so that edges of equal length are equal, and the first of them counts as the longest, whatever the last bits say.
double edge_length(geometry::Space space, const PlacedMesh& mesh, std::uint32_t a, std::uint32_t b) {
  const double length = math::hypot(geometry::distance(space, mesh.floor[a], mesh.floor[b]), mesh.z[a] - mesh.z[b]);
  return static_cast<double>(static_cast<float>(length));
}

/// An edge of a triangle by its two ends.
struct EdgeUse {
  std::uint32_t low, high, triangle;
  int k;  ///< the edge runs from corner k to k + 1
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

/// The triangle across an edge, and which of its edges that is; −1: none.
struct Neighbour {
  int triangle = -1, k = 0;
};

/// Per triangle and edge. Of an edge of more than two triangles the first two, the next two … are neighbours.
std::vector<std::array<Neighbour, 3>> neighbours_of(const PlacedMesh& mesh) {
  std::vector<std::array<Neighbour, 3>> neighbours(mesh.triangles.size());
  const std::vector<EdgeUse> edges = edges_of(mesh);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const EdgeUse &a = edges[i], &b = edges[i + 1];
    if (a.low != b.low || a.high != b.high || a.triangle == b.triangle) continue;
    neighbours[a.triangle][a.k] = {static_cast<int>(b.triangle), b.k};
    neighbours[b.triangle][b.k] = {static_cast<int>(a.triangle), a.k};
    ++i;
  }
  return neighbours;
}

}  // namespace

std::vector<TexelPatch> make_patches(const place::Interior& interior, std::uint32_t part, const surface::PartNormals& normals) {
  const PlacedMesh& mesh = interior.parts[part];
  const auto length = [&](std::uint32_t a, std::uint32_t b) { return edge_length(interior.polygon.space, mesh, a, b); };
  const std::vector<std::array<Neighbour, 3>> neighbours = neighbours_of(mesh);
  std::vector<bool> taken(mesh.triangles.size(), false);
  std::vector<TexelPatch> patches;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (taken[t]) continue;
    taken[t] = true;
    const mesh::Triangle& own = mesh.triangles[t];
    const std::array<double, 3> lengths{length(own[0], own[1]), length(own[1], own[2]), length(own[2], own[0])};
    const int k = static_cast<int>(std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
    TexelPatch patch;
    patch.part = part;
    patch.first = t;
    patch.corner_order = {(k + 2) % 3, k, (k + 1) % 3};
    patch.length_u = lengths[(k + 2) % 3];
    patch.length_v = lengths[(k + 1) % 3];
    const auto [s, m] = neighbours[t][k];
    const auto& corners = normals.corners;
    // The neighbour runs along the common edge the other way round.
    const bool is_smooth = s >= 0 && !taken[s] && mesh.style[s] == mesh.style[t] && corners[s][m] == corners[t][(k + 1) % 3] &&
                           corners[s][(m + 1) % 3] == corners[t][k];
    if (is_smooth) {
      taken[s] = true;
      const mesh::Triangle& across = mesh.triangles[s];
      patch.second = s;
      patch.second_corner_order = {(m + 2) % 3, m, (m + 1) % 3};
      patch.length_u = std::max(patch.length_u, length(across[m], across[(m + 2) % 3]));
      patch.length_v = std::max(patch.length_v, length(across[(m + 1) % 3], across[(m + 2) % 3]));
    } else {
      patch.length_u = patch.length_v = std::max(patch.length_u, patch.length_v);
    }
    patches.push_back(patch);
  }
  return patches;
}

PatchCorner corner_of(const TexelPatch& patch, bool far_u, bool far_v) {
  if (far_u && far_v) return {static_cast<std::size_t>(patch.second), static_cast<std::size_t>(patch.second_corner_order[0])};
  return {patch.first, static_cast<std::size_t>(patch.corner_order[far_u ? 1 : far_v ? 2 : 0])};
}

BarycentricPoint barycentric_point(const TexelPatch& patch, double u, double v) {
  BarycentricPoint place;
  if (patch.second < 0 || u + v <= 1) {
    place.triangle = patch.first;
    place.b[patch.corner_order[0]] = 1 - u - v;
    place.b[patch.corner_order[1]] = u;
    place.b[patch.corner_order[2]] = v;
    return place;
  }
  place.triangle = static_cast<std::size_t>(patch.second);
  place.b[patch.second_corner_order[0]] = u + v - 1, place.b[patch.second_corner_order[1]] = 1 - u,
  place.b[patch.second_corner_order[2]] = 1 - v;
  return place;
}

scene::Color albedo_at(const place::Interior& interior, const place::PlacedMesh& mesh, const TexelPatch& patch, double u, double v) {
  const BarycentricPoint at = barycentric_point(patch, u, v);
  return surface::triangle_albedo(interior, mesh, at.triangle, at.b);
}

bool is_masked_at(const place::Interior& interior, const TexelPatch& patch, double u, double v) {
  if (patch.second < 0 && u + v > 1) {
    u = std::clamp((1 + u - v) / 2, 0.0, 1.0);
    v = 1 - u;
  }
  const BarycentricPoint at = barycentric_point(patch, u, v);
  return place::is_masked_at(interior, interior.parts[patch.part], at.triangle, {at.b[0], at.b[1], at.b[2]});
}

}  // namespace orbc::bake
