#pragma once
#include <optional>
#include <vector>

#include "compiler/base/rational.h"
#include "compiler/base/result.h"
#include "compiler/notation/symbol_text.h"

namespace orbc::notation {

enum class TokenKind { star, order, cross_cap, wonder_ring };

struct Token {
  TokenKind kind;
  std::size_t begin = 0, length = 1;  ///< in characters
  std::optional<Rational> value;      ///< orders only; nothing: ∞
};

struct Tokens {
  std::vector<Token> list;
  bool separated = false;  ///< commas, points or blanks stand between the corners, so that a run of digits is one token
};

/// Divides a symbol of Conway's into tokens. In compact text each digit is a token; where corners are separated, a run of digits is.
/// Makes:       `text.respelled` is set by lists in parentheses, powers, points, TeX and words for ∞.
/// Diagnostics: notation.unexpected-character, notation.unclosed-parenthesis, notation.order-out-of-range, notation.too-many-corners.
[[nodiscard]] Result<Tokens> scan(SymbolText& text);

}  // namespace orbc::notation
