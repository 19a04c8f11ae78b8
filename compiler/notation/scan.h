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
  bool separated = false;  ///< commas, points or blanks stand between the corners: a run of digits is one
};

/// Takes a symbol of Conway's apart. In compact text each digit is a token; where corners are separated, a run of digits is. Lists in
/// parentheses, powers, points, TeX and words for ∞ set `text.respelled`.
[[nodiscard]] Result<Tokens> scan(SymbolText& text);

}  // namespace orbc::notation
