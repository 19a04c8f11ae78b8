#pragma once
#include <span>

#include "compiler/bend/bend.h"

namespace orbc::bend {

/// Clips bent copies to their wedges and height bounds (cover/copy.h), so that each is drawn only where the eye sees it.
/// In:     a cover bent for View::eye from `copies`, where copies with a wedge have all triangles that overlap it, uncut
///         (triangles_touching); how far, in pixels, a cut may be from the true surface of a height bound.
/// Makes:  triangles cut by the upright planes through the eye at the borders of wedges. A height bound becomes a polyline as the eye sees
///         it: triangles are cut by the planes through the eye and its segments, and by the upright planes between segments. Copies on both
///         sides of a cut that were bent alike get the same vertices along it, bit by bit. The same for every executor.
/// Error:  vertices within 4e-7 radians of an upright plane count as on it.
[[nodiscard]] BentCover clip_in_eye_space(BentCover cover, std::span<const cover::Copy> copies, const place::Camera& eye,
                                          double tolerance_px, const Executor& executor);

}  // namespace orbc::bend
