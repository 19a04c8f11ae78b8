#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "compiler/place/placed.h"
#include "compiler/trace/ray.h"

namespace orbc::surface {

/// A vertex of a part with one of the normals it has there.
struct ShadingVertex {
  std::uint32_t vertex = 0;
  trace::Direction normal;  ///< unit, at the vertex
};

/// The normals by which a part is lit: of objects, those of neighbouring triangles that meet at less than the crease angle flow into each
/// other.
struct PartNormals {
  std::vector<ShadingVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> corners;  ///< per triangle, into `vertices`
};

/// In:    crease angle in radians; triangles without area take part in nothing.
/// Makes: the same for doubled vertices (seams of uv) as for one. Floor, ceiling and walls have their exact normals.
[[nodiscard]] PartNormals part_normals(const place::PlacedRoom& room, const place::PlacedMesh& part, double crease = 0.7);

/// How far inside of a triangle what lies on its border is asked for light, of its size: in a corner or at a foot other surfaces begin, and
/// just there rounding would decide whether they hide a lamp.
inline constexpr double kWithin = 1e-3;
/// Corner k so far inside.
[[nodiscard]] inline std::array<double, 3> near_corner(std::size_t k) {
  std::array<double, 3> b{kWithin / 2, kWithin / 2, kWithin / 2};
  b[k] = 1 - kWithin;
  return b;
}

/// The point of a triangle at affine barycentric coordinates, made ready to be lit.
struct LightPoint {
  geometry::Position at;
  trace::Direction normal;  ///< unit: the interpolated one
  /// Where shadow rays start: on the smooth surface, so that flat triangles do not shade themselves at the light's rim; never on a mirror
  geometry::Position origin;
  int wall = -1;                   ///< it lies on this wall
  bool on_triangle = true;         ///< false: on a wall, the floor or the ceiling
  trace::Direction flat = normal;  ///< unit: of the flat triangle; at vertices the normal
};
/// Origin: Hanika, Hacking the shadow terminator, Ray Tracing Gems II (2021), ch. 4: the point projected to the tangent planes of the
///         corners, mixed.
[[nodiscard]] LightPoint light_point(const place::PlacedRoom& room, const place::PlacedMesh& part, const PartNormals& normals,
                                     std::size_t triangle, const std::array<double, 3>& b);
/// A vertex with one of its normals.
[[nodiscard]] LightPoint light_point(const place::PlacedRoom& room, const place::PlacedMesh& part, const ShadingVertex& vertex);

}  // namespace orbc::surface
