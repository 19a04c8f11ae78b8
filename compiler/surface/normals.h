#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "compiler/place/interior.h"
#include "compiler/trace/ray.h"

namespace orbc::surface {

/// A vertex of a part with one of its shading normals. A vertex on a crease has several.
struct ShadingVertex {
  std::uint32_t vertex = 0;
  trace::Direction normal;  ///< unit, at the vertex
};

/// The shading normals of a part.
struct PartNormals {
  std::vector<ShadingVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> corners;  ///< per triangle: indices into `vertices`
};

/// Computes the shading normals of a part. On objects and frames, triangles that meet at less than the crease angle share normals.
/// In:    crease angle in radians. Triangles without area have no influence.
/// Makes: vertices doubled at seams of uv have equal normals. Floor, ceiling and walls have their exact normals.
/// Source: weights by angle, Thürmer and Wüthrich, Computing vertex normals from polygonal facets (1998).
[[nodiscard]] PartNormals part_normals(const place::Interior& interior, const place::PlacedMesh& part, double crease = 0.7);

/// Light at the border of a triangle is computed this far inside of it, as a share of its size. On the border itself another surface may
/// begin, and rounding would decide whether that surface casts a shadow.
inline constexpr double kInset = 1e-3;
/// Barycentric coordinates of corner k of a triangle, moved inside by kInset.
[[nodiscard]] inline std::array<double, 3> inset_corner(std::size_t k) {
  std::array<double, 3> b{kInset / 2, kInset / 2, kInset / 2};
  b[k] = 1 - kInset;
  return b;
}

/// A point of a surface with all that lighting needs of it.
struct ShadingPoint {
  geometry::Position at;
  trace::Direction normal;  ///< unit: the shading normal, interpolated
  /// The start of shadow rays. It lies on the smooth surface, so that flat triangles near the terminator do not shadow themselves, and
  /// never on a mirror.
  geometry::Position ray_origin;
  int wall = -1;                               ///< index of the wall on which the point lies; −1: none
  bool on_triangle = true;                     ///< false: on a wall, the floor or the ceiling
  trace::Direction geometric_normal = normal;  ///< unit: that of the flat triangle; at a vertex the shading normal
};
/// The shading point at affine barycentric coordinates of a triangle.
/// Source: `ray_origin` by Hanika, Hacking the shadow terminator, Ray Tracing Gems II (2021), ch. 4: the point is projected onto the
///         tangent planes of the corners, and the projections are interpolated.
[[nodiscard]] ShadingPoint shading_point(const place::Interior& interior, const place::PlacedMesh& part, const PartNormals& normals,
                                         std::size_t triangle, const std::array<double, 3>& b);
/// The shading point at a vertex with one of its normals.
[[nodiscard]] ShadingPoint shading_point(const place::Interior& interior, const place::PlacedMesh& part, const ShadingVertex& vertex);

}  // namespace orbc::surface
