#pragma once
#include <string>
#include <string_view>

namespace orbc::scene {

/// The commented scene that `orbc new` prints: a furnished room to start from, which teaches the format.
/// In:    a notation that has a room, its number of walls, and the inradius of the room (0 = unknown): all sizes and distances follow from
///        it, so that everything stands within 0.75 inradii of the centre.
/// Makes: a YAML text that `read_scene` takes without a word.
[[nodiscard]] std::string starter_scene(std::string_view notation, int walls, double inradius);

}  // namespace orbc::scene
