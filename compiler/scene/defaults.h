#pragma once
#include "compiler/scene/scene.h"

namespace orbc::scene {

/// The number of walls of a notation's room: `*` 1, `*kk` 2, `*k1…kN` N, strips 4.
[[nodiscard]] int wall_count(const notation::Orbifold& orbifold);
/// The number of its corners: those of the notation; strips have 4, including those at the end walls.
[[nodiscard]] int corner_count(const notation::Orbifold& orbifold);

// Defaults: a mirror on every wall, a checker on the floor, a light ceiling, no lamps.
[[nodiscard]] Surface default_floor();
[[nodiscard]] Surface default_ceiling();
/// Whether wall `number` (from 1) is an end wall, which closes a strip and cannot be a mirror: 2 and 4 of `**`, 3 of `*22∞`.
[[nodiscard]] bool is_end_wall(const notation::Orbifold& orbifold, int number);
/// A wall with one mirror of reflectance 0.9, or a plain end wall.
[[nodiscard]] Wall default_wall(bool is_end);
/// A frame of gilt wood.
[[nodiscard]] Frame default_frame();

/// The default of `max_bounces`.
/// Makes: - flat rooms: 12.
///        - spherical rooms: the length of the group's longest word, at least 12, so that every copy is visible from anywhere; for groups
///        of
///          more than 1000 elements the largest number that gives at most 1000 copies.
///        - hyperbolic rooms: the largest number that gives at most 200 copies, at least 1.
/// In:    `horizontal_mirrors` is the number of mirrors among floor and ceiling; in H² their images of all copies count too.
/// Exact: from the growth series. For hyperbolic rooms with fractional corners, that of the orbifold with the next larger integers, whose
/// copies
///        grow faster.
[[nodiscard]] int default_max_bounces(const notation::Orbifold& orbifold, int horizontal_mirrors = 0);
/// The scene that a file with `orbc: 1` and the notation alone describes.
[[nodiscard]] Scene default_scene(const notation::Orbifold& orbifold);

}  // namespace orbc::scene
