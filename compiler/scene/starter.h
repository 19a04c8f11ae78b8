#pragma once
#include <string>

namespace orbc::scene {

/// What the starter scene must know of a room.
struct StarterRoom {
  std::string notation;             ///< of an orbifold that has a room
  int walls = 1;
  double inradius = 0;              ///< 0 = unknown
  double view = 0;                  ///< direction, in degrees from corner 1, in which the picture looks (room::view_direction)
};

/// The commented scene that `orbc new` prints: a furnished room to start from, which teaches the format.
/// Makes: a YAML text that `read_scene` takes without a word. All sizes and distances follow from the inradius: everything, the eye
///        included, stands within 0.9 inradii of the centre. The eye is at the height of a standing person and looks at the mirrors.
[[nodiscard]] std::string starter_scene(const StarterRoom& room);

}  // namespace orbc::scene
