#pragma once
#include "compiler/scene/scene.h"

namespace orbc::scene {

/// How many walls the room of a notation has: `*` 1, `*kk` 2, `*k1…kN` N; strips 4.
[[nodiscard]] int wall_count(const notation::Orbifold& orbifold);
/// How many corners: as many as the notation has; strips 4, with those where mirrors meet the end walls.
[[nodiscard]] int corner_count(const notation::Orbifold& orbifold);

// What a scene gets that says nothing: every wall one full mirror, a floor checker, a light ceiling (no lamp: plain colours).
[[nodiscard]] Surface default_floor();
[[nodiscard]] Surface default_ceiling();
/// Whether wall `number` (from 1) is a plain wall that closes a strip and cannot be a mirror: 2 and 4 of `**`, 3 of `*22∞`.
[[nodiscard]] bool is_end_wall(const notation::Orbifold& orbifold, int number);
/// A full mirror of reflectance 0.9; the ends of strips are plain.
[[nodiscard]] Wall default_wall(bool is_end);
/// A frame's looks: gilt wood.
[[nodiscard]] Frame default_frame();

/// How far the mirrors are followed when the author does not say. Flat rooms: 12 bounces. Spherical ones: as many as the longest word of
/// the group has walls, at least 12, so that every copy is seen from anywhere (a path of length π meets all the group's mirrors, no copy
/// takes more); of groups of more than 1000 elements as many as give at most 1000 copies. Hyperbolic ones, where copies grow
/// exponentially: as many as give at most 200 copies, but at least 1.
/// In:    `level_mirrors`: how many of floor and ceiling are mirrors; in H² the copies on all storeys count.
/// Exact: from the growth series. Hyperbolic rooms with real corners take the bounces of the orbifold with the next larger integers, whose
///        copies grow faster.
[[nodiscard]] int default_max_bounces(const notation::Orbifold& orbifold, int level_mirrors = 0);
/// The scene that `orbc: 1` and the notation alone describe.
[[nodiscard]] Scene default_scene(const notation::Orbifold& orbifold);

}  // namespace orbc::scene
