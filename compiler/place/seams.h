#pragma once
#include <vector>

#include "compiler/place/placed.h"

namespace orbc::place {

/// Sews panels together again after each was cut by itself (by its texture's repeats): along the foot, the head and the upright edges of
/// every wall all panels get all vertices of each other.
/// In:    floor, ceiling and walls of one room, whose vertices on a common edge lie within 1e-9 of it.
/// Makes: the same surfaces; vertices within 1e-9 along an edge become one place, bit by bit; new vertices have their uv affine between
///        their neighbours'.
[[nodiscard]] std::vector<PlacedMesh> sewn(const room::Room& room, double height, std::vector<PlacedMesh> panels);

}  // namespace orbc::place
