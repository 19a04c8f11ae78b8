#pragma once
#include <vector>

#include "compiler/base/rational.h"

namespace orbc::notation {

/// A kaleidoscopic orbifold: mirrors that meet in corners of angle π/k, in the author's order.
/// `*` has no corners and one wall; `*kk` two walls; `*k1…kN` N walls. Strips run to infinity between two parallel mirrors: `**` has no
/// corner; `*22∞`, the half strip, has a third mirror across, which makes two corners of order 2 with them.
/// Corners that are no integers ("*(3/2)(12)(12)", "*(2.5)44") are exact rationals; such rooms are no orbifolds.
struct Orbifold {
  std::vector<Rational> corners;
  bool strip = false;  ///< a strip, or with the corners {2, 2} the half strip; no other corners
};

/// `*22∞`.
[[nodiscard]] inline bool is_half_strip(const Orbifold& orbifold) { return orbifold.strip && !orbifold.corners.empty(); }

}  // namespace orbc::notation
