#pragma once
#include <vector>

#include "compiler/base/rational.h"

namespace orbc::notation {

/// A kaleidoscopic room: mirrors that meet in corners of angle π/k, in the order in which the author wrote them.
/// `*` has no corners and one wall; `*kk` two walls; `*k1…kN` N walls; `**` (strip) two parallel mirrors and no corner.
/// Corners that are no integers ("*(3/2)(12)(12)", "*(2.5)44") are exact rationals; such rooms are no orbifolds.
struct Orbifold {
  std::vector<Rational> corners;
  bool strip = false;
};

}  // namespace orbc::notation
