#pragma once
#include <cstdint>
#include <vector>

#include "compiler/base/progress.h"
#include "compiler/base/result.h"
#include "compiler/cover/copy.h"
#include "compiler/place/eye.h"
#include "compiler/place/placed.h"

namespace orbc::cover {

struct UnfoldOptions {
  std::uint64_t max_copies = 50'000'000;
  Progress progress;
};

/// Unfolds a room: every copy that the cut-offs leave; on S² also those seen around the sphere, sheet by sheet; with mirrors on floor or
/// ceiling storey by storey. Rooms of orbifolds whose walls' mirrors are all alike go by the group, each copy once and whole; all others by
/// the eye's beams (beam.h), cut to wedges.
/// In:          any convex room; plain walls and mirrors that leave part of a wall are fine: what is behind them is hidden.
/// Makes:       copies by bounces, then sheet, then word; the room itself first. Memory grows with the output only.
/// Exact:       words and their number (no float decides); `min_pixels` is measured, of both roads alike (size.h). What lies behind a
///              copy that it leaves out is left out or hidden by a panel in the mirror through which that copy is seen (driver/tail.h).
/// Diagnostics: cover.too-much beyond `max_copies`, with a max_bounces that fits.
[[nodiscard]] Result<std::vector<Copy>> unfold(const place::PlacedRoom& room, const place::Eye& eye, const scene::CoverSpec& spec,
                                               const UnfoldOptions& options = {});

}  // namespace orbc::cover
