#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "compiler/geometry/isometry.h"
#include "compiler/image/image.h"
#include "compiler/mesh/mesh.h"
#include "compiler/room/room.h"
#include "compiler/scene/scene.h"

namespace orbc::place {

/// The kind of a part of the interior. A wall is shared by two neighbouring copies and drawn once.
enum class PartKind { floor, ceiling, wall, frame, object };

/// The appearance of triangles: a flat colour or a texture through uv, and the material for shading.
struct SurfaceStyle {
  scene::Color color{0.8, 0.8, 0.8};      ///< linear; multiplies the texture
  int texture = -1;                       ///< index into Interior::textures, or −1
  scene::Material material;               ///< as the author wrote it
  double alpha_cutoff = -1;               ///< with a texture: there is no surface where its alpha (0…1) is below this; < 0: no alpha mask
};

/// A mesh of geodesic triangles in room coordinates.
/// Formula: the point with the affine barycentric coordinates b is (normalise(Σ bᵢXᵢ), Σ bᵢzᵢ). Source: design §2.
struct PlacedMesh {
  PartKind kind = PartKind::object;
  std::string name;                       ///< "floor", "wall 2", the object's name
  int wall = -1;                          ///< kind wall or frame: the wall's index (from 0)
  std::vector<geometry::Point> floor;     ///< per vertex: the point of the floor plane below it
  std::vector<double> z;                  ///< per vertex: its height
  std::vector<std::array<float, 2>> uv;   ///< per vertex, v downwards; or empty
  std::vector<mesh::LinearColor> color;             ///< per vertex: a factor of the style's colour; or empty
  std::vector<geometry::Vector3> pattern_position;  ///< per vertex: coordinates of the object, for solid patterns; or empty
  std::vector<mesh::Triangle> triangles;  ///< counter-clockwise seen from outside (walls, floor, ceiling: seen from inside the room)
  std::vector<std::uint16_t> style;       ///< per triangle: index into Interior::styles
};

/// A mirror: a rectangle on a wall, clipped to the wall, or all of the floor or ceiling.
struct PlacedMirror {
  int wall = 0;                           ///< index of the wall (from 0); −1 the floor, −2 the ceiling
  double span[2] = {0, 0};                ///< arc length along the wall
  double height[2] = {0, 0};              ///< above the floor
  scene::Color throughput{0.9, 0.9, 0.9};  ///< share of the light that it reflects: reflectance × tint
  scene::Color emission{0, 0, 0};         ///< radiance that the mirror emits itself
};

/// A furnished room: its polygon and everything visible in it, in room coordinates.
struct Interior {
  room::Room polygon;
  double height = 1;
  std::vector<PlacedMesh> parts;
  std::vector<PlacedMirror> mirrors;
  std::vector<SurfaceStyle> styles;
  std::vector<image::Image> textures;
};

}  // namespace orbc::place
