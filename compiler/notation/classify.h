#pragma once
#include "compiler/base/result.h"
#include "compiler/geometry/space.h"
#include "compiler/notation/orbifold.h"

namespace orbc::notation {

/// The space of constant curvature in which the room exists, by the sign of χ.
/// In:          corners of any rational order.
/// Exact:       rational arithmetic.
/// Diagnostics: notation.bad-orbifold (one corner, two different ones, a spherical triangle of real corners that cannot close),
///              notation.order-out-of-range (a corner of order ≤ 1 or above the bound), notation.too-many-corners.
[[nodiscard]] Result<geometry::Space> classify(const Orbifold& orbifold, const SourceSpan& span = {});

}  // namespace orbc::notation
