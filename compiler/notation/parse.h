#pragma once
#include <string_view>

#include "compiler/base/result.h"
#include "compiler/notation/orbifold.h"

namespace orbc::notation {

/// The limits of an orbifold. A word of the cover stores a wall in a byte; larger orders look alike.
inline constexpr int kMaxCorners = 256;
inline constexpr int kMaxOrder = 1'000'000;

struct ParseOptions {
  SourceSpan span;                  ///< the place of the text in its file; without a source, diagnostics quote the text itself
  bool allow_non_orbifold = false;  ///< corners that are no integers, "(3/2)" or "(2.5)"
};

/// An orbifold, and notes on how its text was read.
struct Parsed {
  Orbifold orbifold;
  Diagnostics notes;  ///< notation.corner-of-order-one, notation.read-as
};

/// Reads Conway's notation of a kaleidoscopic orbifold: `*22222`, `*23(10)`, `*2 3 10`, `*2,3,(10)`, `∗237`, `*`, the strip `**`.
/// In compact text each digit is a corner; where a comma, or a blank between two digits, separates the corners, each run of digits is one.
/// Makes:       corners in the author's order; those of order 1 (straight angles) are left out with a note.
/// Exact:       rationals throughout; parse(to_text(o)) = o.
/// Diagnostics: notation.empty, notation.too-long, notation.unexpected-character, notation.unclosed-parenthesis,
///              notation.order-out-of-range, notation.non-orbifold-corner, notation.too-many-corners, notation.not-kaleidoscopic,
///              notation.not-closed, notation.no-room, notation.bad-orbifold. Carets point into the text.
[[nodiscard]] Result<Parsed> parse_with_notes(std::string_view text, const ParseOptions& options = {});
/// The same without the notes.
[[nodiscard]] Result<Orbifold> parse(std::string_view text, const ParseOptions& options = {});

}  // namespace orbc::notation
