#pragma once
#include <string>

#include "compiler/notation/orbifold.h"

namespace orbc::notation {

/// "*22222", "*23(10)", "*(3/2)44", "*", "**", "*22∞": compact, in the orbifold's own corner order.
[[nodiscard]] std::string to_text(const Orbifold& orbifold);

/// The lexicographically smallest rotation or reflection of the corners: `*362` and `*632` become `*236`.
[[nodiscard]] Orbifold canonical(const Orbifold& orbifold);

[[nodiscard]] bool operator==(const Orbifold& left, const Orbifold& right);
[[nodiscard]] inline bool operator!=(const Orbifold& left, const Orbifold& right) { return !(left == right); }

}  // namespace orbc::notation
