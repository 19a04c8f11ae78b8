#pragma once
#include <vector>

#include "compiler/place/interior.h"

namespace orbc::place {

/// Makes panels watertight again that were cut independently of each other (at the repeats of their textures). Along the foot, the head and
/// the vertical edges of every wall each panel gets the vertices of its neighbours.
/// In:    floor, ceiling and walls of one room, whose vertices on a common edge lie within 1e-9 of the room's size of it.
/// Makes: the same surfaces. Vertices within 1e-9 of each other along an edge become equal bit by bit; new vertices get uv that are linear
///        between their neighbours'.
[[nodiscard]] std::vector<PlacedMesh> stitch_panels(const room::Room& room, double height, std::vector<PlacedMesh> panels);

}  // namespace orbc::place
