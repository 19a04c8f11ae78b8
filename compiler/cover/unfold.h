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

/// Unfolds a room of an orbifold: every copy that the cut-offs leave, once; on S² also those seen around the sphere, sheet by sheet.
/// In:          all mirrors alike in reflectance and tint; plain walls and mirrors that leave part of a wall are fine: what is behind them is hidden.
/// Makes:       copies by bounces, then sheet, then word; the room itself first. Memory grows with the output only.
/// Exact:       words and their number (no float decides); `min_pixels` is measured: the smaller extent of the room's circumscribed
///              cylinder in the middle of the picture.
/// Diagnostics: cover.mixed-mirrors, cover.storeys, cover.not-an-orbifold; cover.too-much beyond `max_copies`, with a max_bounces that fits.
[[nodiscard]] Result<std::vector<Copy>> unfold(const place::PlacedRoom& room, const place::Eye& eye, const scene::CoverSpec& spec,
                                               const UnfoldOptions& options = {});

}  // namespace orbc::cover
