#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compiler/cover/height_bounds.h"
#include "compiler/cover/wedge.h"
#include "compiler/geometry/isometry.h"
#include "compiler/scene/color.h"

namespace orbc::cover {

/// The walls (from 0) that a path from the eye to a copy crosses, nearest first. The copy is the image of the room under
/// s_{word[0]} · s_{word[1]} · …, where s_i is the reflection in wall i, in room coordinates.
using Word = std::vector<std::uint8_t>;

/// An image of the room in mirrors on floor and ceiling: the height z of the room becomes sign·z + offset.
struct Storey {
  int number = 0;  ///< 0: the room itself; 1, 2, … above; −1, −2, … below. |number| mirrors lie between
  double sign = 1, offset = 0;
};

/// An image of the room. `cover_from_room` maps room coordinates to the universal cover, in which the room itself is one of the copies.
struct Copy {
  geometry::Isometry cover_from_room;
  Word word;        ///< ShortLex normal form; in rooms that are no orbifolds: the walls on the path
  int bounces = 0;  ///< mirrors between the eye and the copy on this sheet; the word's length on sheet 0
  int sheet = 0;    ///< S²: half turns of the sphere after which the copy is seen: a point at distance r is seen on sheet 0 at
                    ///< r, on sheet 1 at 2π − r in the opposite direction, on sheet 2 at 2π + r; always 0 elsewhere
  scene::Color weight{1, 1, 1};        ///< product of the mirrors' throughputs on the path
  std::uint64_t eye_facing_walls = 0;  ///< bit i: the copy across wall i is nearer to the eye and draws this wall. Walls from 64 on: unset
  std::optional<Wedge> wedge;          ///< the bearings in which the copy is seen; nothing: all
  std::vector<HeightBound> height_bounds;  ///< within the wedge, the heights at which the copy is seen; without a wedge: empty
  Storey storey;
};

/// The bit of a wall in Copy::eye_facing_walls; 0 for walls that have none.
[[nodiscard]] inline std::uint64_t wall_bit(int wall) { return wall >= 0 && wall < 64 ? std::uint64_t{1} << wall : 0; }
[[nodiscard]] inline bool faces_eye(const Copy& copy, int wall) { return (copy.eye_facing_walls & wall_bit(wall)) != 0; }

/// The walls counted from 1: "1 3 2"; "" for the room itself.
[[nodiscard]] std::string to_string(const Word& word);

}  // namespace orbc::cover
