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

/// What kind of thing a part of the room is; walls are shared by two neighbouring copies and drawn once.
enum class PartKind { floor, ceiling, wall, frame, object };

/// A look that fills a triangle: a flat colour (linear), a picture through uv, or a mirror that is no triangle of any part.
struct Look {
  scene::Color color{0.8, 0.8, 0.8};
  int texture = -1;          ///< index into PlacedRoom::textures; then `color` multiplies it
  scene::Material material;  ///< the author's words, for shading
  double cutoff = -1;        ///< with a texture: texels of less alpha (0…1) than this are holes; < 0: there are none
};

/// A mesh of geodesic triangles in room coordinates: point(b) = (normalise(Σ bᵢXᵢ), Σ bᵢzᵢ) with affine b. Source: design §2.
struct PlacedMesh {
  PartKind kind = PartKind::object;
  std::string name;                                 ///< "floor", "wall 2", the object's name
  int wall = -1;                                    ///< kind == wall or frame: which (from 0)
  std::vector<geometry::Point> floor;               ///< per vertex
  std::vector<double> z;                            ///< per vertex
  std::vector<std::array<float, 2>> uv;             ///< per vertex (v from top to bottom), or empty
  std::vector<geometry::Vector3> pattern_position;  ///< per vertex: the object's own coordinates, for solid patterns; or empty
  std::vector<mesh::Triangle> triangles;            ///< counter-clockwise seen from where it is looked at (walls: from inside the room)
  std::vector<std::uint16_t> look;                  ///< per triangle, index into PlacedRoom::looks
};

/// A mirror as both roads see it: a rectangle on a wall, clipped to the wall.
struct PlacedMirror {
  int wall = 0;             ///< from 0; −1 the floor, −2 the ceiling
  double span[2] = {0, 0};  ///< arc length along the wall
  double height[2] = {0, 0};
  scene::Color throughput{0.9, 0.9, 0.9};  ///< share of the light that it reflects: reflectance × tint
  scene::Color glow{0, 0, 0};              ///< radiance of its own
};

/// The furnished room: everything there is to see, in room coordinates, before any copy is made.
struct PlacedRoom {
  room::Room room;
  double height = 1;
  std::vector<PlacedMesh> parts;
  std::vector<PlacedMirror> mirrors;
  std::vector<Look> looks;
  std::vector<image::Image> textures;
};

}  // namespace orbc::place
