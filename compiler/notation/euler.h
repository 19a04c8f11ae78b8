#pragma once
#include "compiler/base/rational.h"
#include "compiler/notation/orbifold.h"

namespace orbc::notation {

/// χ = Σ 1/(2kᵢ) − N/2 + 1; 1 for `*`, 0 for strips. The room's area is 2π|χ| on S² and H². Source: paper, appendix; design §3.
[[nodiscard]] Rational euler_characteristic(const Orbifold& orbifold);

/// Whether all corners are integers, so that the copies of the room tile its space.
[[nodiscard]] bool is_orbifold(const Orbifold& orbifold);

}  // namespace orbc::notation
