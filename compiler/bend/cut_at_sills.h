#pragma once
#include <vector>

#include "compiler/bend/bend.h"

namespace orbc::bend {

/// Cuts bent copies at their sills (cover/sill.h), so that of mirrors above each other each shows its own copies.
/// In:     a cover bent for View::eye from `copies`; the eye; how far, in pixels, a cut may lie from the true sill.
/// Makes:  each sill as a polyline as the eye sees it; the triangles are cut by the planes through the eye and its pieces, and by the upright planes between
///         these. Copies above and below one sill, bent alike, get the same vertices along it bit by bit.
void cut_at_sills(BentCover& cover, const std::vector<cover::Copy>& copies, const place::Eye& eye, double tolerance_px);

}  // namespace orbc::bend
