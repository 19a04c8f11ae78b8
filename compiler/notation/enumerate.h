#pragma once
#include <functional>
#include <optional>

#include "compiler/base/result.h"
#include "compiler/geometry/space.h"
#include "compiler/notation/orbifold.h"

namespace orbc::notation {

/// Called with each orbifold, in canonical form, and its space; returns false to end the list.
using OrbifoldVisitor = std::function<bool(const Orbifold&, geometry::Space)>;

/// Lists all good kaleidoscopic orbifolds with `corners` corners of order at most `max_order`, each once: the spherical ones, then the
/// Euclidean, then the hyperbolic, lexicographically within each (the paper's Table 1). One corner means `*`, as there.
/// Makes:       true when the list was not ended by the visitor.
/// Memory:      independent of the count, which grows like max_order^corners/(2·corners) (count_orbifolds).
/// Diagnostics: notation.enumerate-out-of-range.
[[nodiscard]] Result<bool> enumerate(int corners, int max_order, const OrbifoldVisitor& visit);

/// How many orbifolds `enumerate` lists, or how many of one space, exactly. Source: Burnside's lemma on necklaces up to rotation and
/// reflection.
[[nodiscard]] Result<Integer> count_orbifolds(int corners, int max_order, std::optional<geometry::Space> space = {});

}  // namespace orbc::notation
