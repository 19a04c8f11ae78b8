#pragma once
#include <array>
#include <optional>

#include "compiler/place/interior.h"
#include "compiler/trace/follow.h"

namespace orbc::surface {

/// What the albedo of a surface point depends on.
struct AlbedoQuery {
  int style = -1;                                   ///< index into Interior::styles; −1: the albedo is `color`
  scene::Color color{0.8, 0.8, 0.8};                ///< linear; the flat colour of the style, of checkers that of the cell
  double uv[2] = {0, 0};                            ///< texture coordinates, in repeats
  std::optional<geometry::Vector3> solid_position;  ///< the point in the coordinates of solid patterns; none: the part has no such pattern
};

/// The albedo of a surface point: its flat colour, its texel (nearest) times the colour of its style, or its solid pattern.
/// Makes: linear colour. The tracer and the bake both call this function.
[[nodiscard]] scene::Color albedo(const place::Interior& interior, const AlbedoQuery& query);
/// The albedo where a ray has ended.
[[nodiscard]] scene::Color hit_albedo(const place::Interior& interior, const trace::SurfacePoint& point);
/// The albedo at a point of a triangle. In: affine barycentric coordinates, in the order of the triangle's corners; uv in [0, 1]².
[[nodiscard]] scene::Color triangle_albedo(const place::Interior& interior, const place::PlacedMesh& part, std::size_t triangle,
                                           const std::array<double, 3>& b);

/// Whether the albedo changes inside triangles of a style on this part: by a texture, or by a solid pattern if the part can have one.
/// In: index into Interior::styles; −1: none.
[[nodiscard]] bool varies_in_triangle(const place::Interior& interior, const place::PlacedMesh& part, int style);

/// A point of floor, ceiling or a wall in the coordinates of solid patterns: the disk chart scaled to true size at its centre (E²: the
/// plane itself), and the height. They depend on the point alone and on no triangle.
[[nodiscard]] geometry::Vector3 shell_position(geometry::Space space, const geometry::Position& at);

/// The share of the second colour at a point of a solid pattern.
/// In:     the pattern's size `cell`, > 0, in the units of `at`.
/// Makes:  a number in [0, 1]; 0 for patterns that are not solid. Marble: veins where a sine over sheets, bent by turbulence, is near 0.
///         Wood: rings around an axis. Granite: grains of several octaves.
/// Source: Perlin, An image synthesizer (1985), with value noise on an integer lattice. The lattice is hashed without tables, so the
///         numbers are the same on every machine.
[[nodiscard]] double solid_pattern(scene::Pattern pattern, const geometry::Vector3& at, double cell);

}  // namespace orbc::surface
