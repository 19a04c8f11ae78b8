#pragma once
#include <cstdint>
#include <vector>

#include "compiler/base/progress.h"
#include "compiler/base/result.h"
#include "compiler/cover/copy.h"
#include "compiler/place/camera.h"
#include "compiler/place/interior.h"

namespace orbc::cover {

struct UnfoldOptions {
  std::uint64_t max_copies = 50'000'000;
  Progress progress;
};

/// Unfolds a room into all its copies within the cut-offs of `spec`: on S² sheet by sheet, with mirrors on floor or ceiling storey by
/// storey. Where all mirrors on walls have one throughput and all angles are π/k, the group enumerates the copies, each once and as a
/// whole; other rooms are unfolded along the eye's beams (beam.h), and copies have wedges.
/// In:          any convex room. Walls may be plain, and mirrors may cover parts of walls: both hide what lies behind.
/// Makes:       copies by bounces, then sheet, then word; the room itself first. Memory grows with the number of copies only.
/// Exact:       words and their number (no floating-point number decides). `min_pixels` compares measured sizes (projected_size.h).
///              What lies behind a copy below `min_pixels` is left out too, or hidden by a panel in its mirror (cutoff/impostor.h).
/// Diagnostics: cover.too-much beyond `max_copies`, with a max_bounces that fits.
[[nodiscard]] Result<std::vector<Copy>> unfold(const place::Interior& room, const place::Camera& eye, const scene::CoverSpec& spec,
                                               const UnfoldOptions& options = {});

}  // namespace orbc::cover
