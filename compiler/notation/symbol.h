#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "compiler/base/rational.h"
#include "compiler/base/result.h"

namespace orbc::notation {

/// Any symbol of Conway's orbifold notation: handles, cone points, mirror boundaries with their corners, cross-caps. Orders are integers of
/// at least 2. Source: Conway and Huson, The orbifold notation for two-dimensional groups (2002).
struct Symbol {
  int handles = 0;
  std::vector<int> cones;
  std::vector<std::vector<int>> boundaries;  ///< corners, counter-clockwise
  int crosscaps = 0;
};

/// Reads a symbol: digits before the first star are cone points, those after a star corners of its boundary; `o` is a handle, `x` a
/// cross-cap. Makes: corners and cone points of order 1 are left out.
/// Diagnostics: those of parse_with_notes for the text itself; notation.order-out-of-range for orders that are no integers, or infinite.
[[nodiscard]] Result<Symbol> parse_symbol(std::string_view text, const SourceSpan& span = {});

/// The symbol in the usual order: handles, cone points, boundaries, cross-caps.
[[nodiscard]] std::string to_text(const Symbol& symbol);

/// The same for all symbols of one orbifold: cone points and boundaries descend, each boundary begins where it reads largest. Beside a
/// cross-cap a handle is worth two cross-caps, and boundaries may be read either way; without one all of them are read the other way
/// together, whichever is larger.
[[nodiscard]] Symbol canonical(const Symbol& symbol);

/// χ = 2 − 2h − c − Σ(1 − 1/m) − k − Σ½(1 − 1/n), over cone points m and corners n; h handles, c cross-caps, k boundaries.
[[nodiscard]] Rational euler_characteristic(const Symbol& symbol);

/// Whether mirrors alone close its room: one boundary, and nothing else.
[[nodiscard]] bool is_kaleidoscopic(const Symbol& symbol);

/// Whether no element of its group reverses orientation: there are neither mirrors nor cross-caps.
[[nodiscard]] bool is_orientable(const Symbol& symbol);

/// Why no surface of constant curvature has this symbol; "" if one has. Bad are m, mn, *m and *mn for different m and n, alone.
[[nodiscard]] std::string why_bad(const Symbol& symbol);

}  // namespace orbc::notation
