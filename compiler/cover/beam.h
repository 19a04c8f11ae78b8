#pragma once
#include <cstdint>
#include <vector>

#include "compiler/base/progress.h"
#include "compiler/base/result.h"
#include "compiler/cover/copy.h"
#include "compiler/place/camera.h"
#include "compiler/place/interior.h"

namespace orbc::cover {

struct BeamOptions {
  std::uint64_t max_beams = 2'000'000;  ///< of about kBytesPerBeam bytes each (plan.h)
  Progress progress;
};

/// Unfolds a room along the beams of its eye. A beam is the set of rays that cross the same mirrors: an interval of bearings, between
/// height bounds where mirrors stand above each other. Beams are split at corners, at the ends of mirrors and by height, and end at plain
/// walls, after `max_bounces` and below `min_weight`.
/// In:          any convex room: mirrors of different throughput, plain walls, several mirrors on a wall, angles that are no π/k. Mirrors
///              on floor and ceiling have no influence (storeys.h).
/// Makes:       copies by bounces, then sheet, word and bearing; the room itself first.
///              In an orbifold, all beams that reach one group element on one sheet become one copy without wedge, if they have one weight;
///              else one copy for each run of neighbouring beams of one weight. In other rooms every copy has the wedge in which it is
///              seen, and height bounds where mirrors above each other differ. Wedges of neighbouring copies store their common border
///              with equal bits. All copies of one element store one isometry.
/// Exact:       which copies there are, by normal forms (automaton.h). Bearings closer than 1e-12 radians count as one, which is far more
///              than their rounding; all other decisions compare stored bearings whose order rounding cannot change.
/// Diagnostics: cover.too-much beyond `max_beams`: the hint names a max_bounces that fits.
[[nodiscard]] Result<std::vector<Copy>> unfold_by_beams(const place::Interior& room, const place::Camera& eye, const scene::CoverSpec& spec,
                                                        const BeamOptions& options = {});

/// Whether the copies of a room depend on the path to them, so that its group alone (unfold.h) does not give them: an angle is no π/k, or
/// mirrors on walls differ in throughput.
[[nodiscard]] bool needs_beams(const place::Interior& room);

}  // namespace orbc::cover
