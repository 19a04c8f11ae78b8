#pragma once
#include <string>

namespace orbc::scene {

/// The properties of a room that the starter scene depends on.
struct StarterRoom {
  std::string notation;             ///< of an orbifold that has a room
  int walls = 1;
  double inradius = 0;              ///< 0: unknown
  double view = 0;                  ///< direction of view in degrees from corner 1 (room::view_direction)
};

/// The scene that `orbc new` prints: a furnished room with comments that explain the format.
/// Makes: a YAML text that `read_scene` reads without diagnostics. All sizes and distances are in proportion to the inradius; objects and
/// eye
///        stand within 0.9 inradii of the centre. The eye is at the height of a standing person and looks at the mirrors.
[[nodiscard]] std::string starter_scene(const StarterRoom& room);

}  // namespace orbc::scene
