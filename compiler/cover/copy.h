#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compiler/cover/sill.h"
#include "compiler/cover/wedge.h"
#include "compiler/geometry/isometry.h"
#include "compiler/scene/color.h"

namespace orbc::cover {

/// The walls (from 0) through which a copy is reached, first the one nearest to the eye's own room: the image of the room under
/// s_{word[0]} · s_{word[1]} · … in room coordinates.
using Word = std::vector<std::uint8_t>;

/// Mirrors on floor and ceiling stack images of the room: heights z of the room are at sign·z + offset.
struct Storey {
  /// 0 the room itself, 1, 2, … above, −1, −2, … below; |number| mirrors on floor and ceiling lie between
  int number = 0;
  double sign = 1, offset = 0;
};

/// An image of the room. `cover_from_room` takes room coordinates to the universal cover, whose base copy is the room itself.
struct Copy {
  geometry::Isometry cover_from_room;
  Word word;                        ///< ShortLex normal form; of rooms that are no orbifolds: the walls on the way
  int bounces = 0;                  ///< mirrors between the eye and this sheet of this copy; = word length on sheet 0
  int sheet = 0;                    ///< S²: distances r + kπ …: sheet k shows what lies k half turns away; 0 elsewhere
  scene::Color weight{1, 1, 1};     ///< product of reflectance × tint on the way
  /// Bit i: wall i faces the eye (the copy across it is nearer); that wall is drawn there. Up to 64 walls; all further ones are drawn.
  std::uint64_t nearer_walls = 0;
  /// What is seen of this copy in other directions is not this copy: it is cut there. Nothing: all of it is drawn
  std::optional<Wedge> wedge;
  std::vector<Sill> sills;          ///< with a wedge only: of what it holds, this copy is what is seen above and below these
  Storey storey;
};

/// "1 3 2" (walls from 1), "" for the room itself.
[[nodiscard]] std::string to_string(const Word& word);

}  // namespace orbc::cover
