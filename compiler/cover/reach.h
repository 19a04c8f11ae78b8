#pragma once
#include <functional>
#include <vector>

#include "compiler/base/result.h"
#include "compiler/cover/enumerate.h"
#include "compiler/place/eye.h"
#include "compiler/place/placed.h"

namespace orbc::cover {

/// How far the cover of a room is shown: the cut-offs of a scene, in the terms of the enumeration.
struct Reach {
  int max_bounces = 0;                      ///< by `max_bounces` and `min_weight` together
  std::vector<scene::Color> weight;         ///< by bounces, 0 … max_bounces: multiplied mirror by mirror as the tracer does
  std::vector<int> wall;                    ///< letter of the automaton → wall of the room (`**`: 0 and 2; `*22∞`: 0, 1 and 3)
  std::vector<bool> open;                   ///< by letter: the wall carries a mirror
  std::vector<geometry::Isometry> mirrors;  ///< by letter: the reflection in the wall
  int half_turn = 0;                        ///< S²: bounces of every path of length π, the length of the longest word; 0 elsewhere
  int sheets = 1;                           ///< S²: how many sheets have copies within reach
  double min_pixels = 0;                    ///< copies smaller than this (size.h) are left out
};

/// In:          a furnished room of an orbifold whose walls' mirrors are all alike; mirrors on floor and ceiling are not looked at.
/// Diagnostics: cover.mixed-mirrors, cover.not-an-orbifold: these need beams (beam.h).
[[nodiscard]] Result<Reach> reach_of(const place::PlacedRoom& room, const scene::CoverSpec& spec);

/// Visits every copy within reach of sheet 0 in the order of `enumerate`; visit(element, cover_from_room) → Walk. Copies behind plain walls
/// and those below `min_pixels` are passed over.
/// Why plain walls bar a wall's letter altogether: two reduced words of one element have the same letters (Tits), so whatever straight path
/// leads to a copy whose word has the letter crosses an image of that wall.
void walk_reach(const Reach& reach, const place::PlacedRoom& room, const place::Eye& eye,
                const std::function<Walk(const Element&, const geometry::Isometry&)>& visit);

/// Bounces of a copy with word length `length` on a sheet (cover/copy.h).
[[nodiscard]] int bounces_on(const Reach& reach, int length, int sheet);

}  // namespace orbc::cover
