#pragma once
#include <vector>

#include "compiler/bend/bend.h"

namespace orbc::bend {

/// Cuts bent copies to what is seen of them: to their wedges, and at their sills (cover/sill.h), so that of mirrors above each other each
/// shows its own copies.
/// In:     a cover bent for View::eye from `copies`, of those with a wedge all triangles that reach into it, whole (reaching, clip.h); the
///         eye; how far, in pixels, a cut may lie from the true sill.
/// Makes:  the triangles cut by upright planes through the eye at the borders of wedges. Each sill becomes a polyline as the eye sees it;
///         the triangles are cut by the planes through the eye and its pieces, and by the upright planes between these. Copies on both
///         sides of a cut, bent alike, get the same vertices along it bit by bit; and across a wall what is cut fits what is not, since
///         both were split alike before. The same for any executor.
/// Error:  vertices within 4e-7 radians of an upright plane count as on it.
[[nodiscard]] BentCover cut_as_seen(BentCover cover, const std::vector<cover::Copy>& copies, const place::Eye& eye, double tolerance_px,
                                    const Executor& executor);

}  // namespace orbc::bend
