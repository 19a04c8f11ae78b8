#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "compiler/surface/normals.h"

namespace orbc::html {

/// A vertex of a drawn mesh: a point of a triangle of the interior.
struct DrawnVertex {
  std::uint32_t part = 0, triangle = 0;  ///< of Interior::parts
  std::array<double, 3> b{1, 0, 0};      ///< affine barycentric coordinates
};

/// Triangles of one style, or of several that need no pattern; the page draws it in one go.
struct DrawnMesh {
  int style = -1;                      ///< index into Interior::styles; −1: plain colors, which the vertices have
  int part = -1;                       ///< index into Interior::parts; −1: several
  std::vector<std::uint32_t> indices;  ///< into all vertices, three a triangle
};

/// All objects, frames and lamps of an interior as triangles short enough for the log map: no edge is longer than `max_edge`, so that
/// straight edges on the screen stand for geodesics.
struct DrawnMeshes {
  std::vector<DrawnVertex> vertices;
  std::vector<float> positions;    ///< w, x, y, z a vertex
  std::vector<float> normals;      ///< w, x, y, z a vertex: the shading normal at it
  std::vector<float> colors;       ///< r, g, b a vertex: the style's color times the vertex's own
  std::vector<float> coordinates;  ///< 3 a vertex: of solid patterns; of textures u, v, 0
  std::vector<DrawnMesh> meshes;
};

/// Splits triangles at the middles of their long edges. Triangles that share an edge split it in the same point, so that no cracks appear.
/// In: the normals of all parts (surface::part_normals).
[[nodiscard]] DrawnMeshes drawn_meshes(const place::Interior& interior, const std::vector<surface::PartNormals>& normals, double max_edge);

}  // namespace orbc::html
