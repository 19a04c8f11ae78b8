#pragma once
#include <cstdint>
#include <vector>

#include "compiler/base/progress.h"
#include "compiler/base/result.h"
#include "compiler/cover/copy.h"
#include "compiler/place/eye.h"
#include "compiler/place/placed.h"

namespace orbc::cover {

struct BeamOptions {
  std::uint64_t max_beams = 2'000'000;  ///< about 500 bytes each: a gigabyte in some seconds
  Progress progress;
};

/// Unfolds a room along the eye's own beams: angular intervals go out through the mirrors, split at corners and at the ends of mirrors and
/// by height between mirrors above each other, and end at plain walls, after
/// `max_bounces` and below `min_weight`. Any convex room: mirrors of different reflectance, plain walls, several mirrors on a wall, corners
/// that are no π/k.
/// In:          mirrors on floor and ceiling are not looked at (storeys.h).
/// Makes:       copies by bounces, then sheet, then word, then bearing; the room itself first. Of an orbifold, the beams of one group
///              element on one sheet become one copy without wedge when all have one weight; else one copy for each run of neighbouring
///              beams of one weight. Of other rooms each copy is cut to the wedge in which it is seen, and where mirrors above each other
///              differ, by sills. Wedges of neighbouring copies share their border bit by bit; all copies of one element share their
///              isometry.
/// Exact:       which copies: by normal form (automaton.h). Bearings closer than 1e-12 radians count as one, far above the rounding of
///              their computation; all further decisions compare stored bearings whose order rounding cannot turn.
/// Diagnostics: cover.too-much beyond `max_beams`: the hint names a max_bounces that fits.
[[nodiscard]] Result<std::vector<Copy>> unfold_by_beams(const place::PlacedRoom& room, const place::Eye& eye, const scene::CoverSpec& spec,
                                                        const BeamOptions& options = {});

/// Whether the copies of the group (unfold.h) do not tell the truth: a corner is no π/k, or mirrors of walls differ in reflectance or tint.
[[nodiscard]] bool needs_beams(const place::PlacedRoom& room);

}  // namespace orbc::cover
