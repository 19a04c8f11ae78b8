#pragma once
#include <array>

#include "compiler/place/placed.h"
#include "compiler/trace/follow.h"

namespace orbc::surface {

/// What a surface is looked up by at one of its points.
struct SurfaceKey {
  int look = -1;                       ///< index into PlacedRoom::looks; −1: none
  scene::Color color{0.8, 0.8, 0.8};   ///< the look's flat colour (of checkers the cell's)
  double uv[2] = {0, 0};               ///< textures, in repeats
  bool solid = false;                  ///< whether `pattern_position` means something
  geometry::Vector3 pattern_position;  ///< the object's own coordinates, or the shell's
};

/// Whether the solid patterns have a meaning on a part: objects carry their own coordinates, floor, ceiling and walls are cut from one
/// solid.
[[nodiscard]] bool has_solid(const place::PlacedMesh& part);
/// Where a point of floor, ceiling or a wall lies in that solid: the disk chart's coordinates at true size in the centre (E²: its own), and
/// the height. The same point of a wall gets the same stone from both roads, whatever triangle it is in.
[[nodiscard]] geometry::Vector3 shell_position(geometry::Space space, const geometry::Position& at);
/// Fills in what solid patterns need. In: the point, and the part's own coordinates there, if it has any.
void set_solid(const place::PlacedRoom& room, const place::PlacedMesh& part, const geometry::Position& at, const geometry::Vector3& own,
               SurfaceKey& key);

/// The colour of a surface point without any light: flat, texel (nearest) times colour, or solid pattern. One function for both roads.
[[nodiscard]] scene::Color surface_albedo(const place::PlacedRoom& room, const SurfaceKey& key);

/// The colour of a surface point without any light: surface_albedo where a ray has ended.
[[nodiscard]] scene::Color surface_color(const place::PlacedRoom& room, const trace::SurfacePoint& point);

/// The same at affine barycentric coordinates of a triangle, its textures' uv in [0, 1]².
[[nodiscard]] scene::Color triangle_albedo(const place::PlacedRoom& room, const place::PlacedMesh& part, std::size_t triangle,
                                           const std::array<double, 3>& b);

/// Whether the colour changes inside triangles of this look: by a texture, or, on a part where they mean something, by a solid pattern.
[[nodiscard]] bool varies(const place::PlacedRoom& room, int look, bool solid);

/// The solid patterns by themselves: how much of the second colour stands at a point, 0…1; `cell` is their size.
/// marble: veins where a sine over sheets, bent by turbulence, comes near its turns; wood: rings around a trunk's axis; granite: grains of
/// several octaves.
/// Source: Perlin, An image synthesizer (1985); value noise on an integer lattice hashed without tables, so that every machine sees the
///         same stone.
[[nodiscard]] double solid_pattern(scene::Pattern pattern, const geometry::Vector3& at, double cell);

}  // namespace orbc::surface
