#pragma once
#include <string>
#include <string_view>

#include "compiler/diff/finding.h"

namespace orbc::diff {

enum class TokenKind { end, number, word, sign, text, comment, file };

/// A piece of a text: views into it.
struct Token {
  TokenKind kind = TokenKind::end;
  std::string_view text;   ///< as it stands there; of texts, comments and files what is inside
  std::string_view bytes;  ///< of a file: its base64
  double value = 0;        ///< of a number
  bool whole = false;      ///< a number written without point and exponent
  std::size_t at = 0;      ///< offset in the text
};

/// How a text falls into tokens.
enum class Grammar {
  pov,  ///< words of letters, digits and _; "texts"; comments; `/* orbc-file NAME base64 … */` is a file
  svg,  ///< letters and digits fall apart, as in path data; #rrggbb is a word, quotes are signs
};

/// Cuts a text into tokens. Any bytes are taken; whatever is not understood is a sign of one byte. Blanks between tokens do not count.
class Tokens {
 public:
  Tokens(std::string_view text, Grammar grammar) : text_(text), grammar_(grammar) {}
  [[nodiscard]] Token next();

 private:
  [[nodiscard]] bool number(Token& token);
  [[nodiscard]] bool comment(Token& token);
  [[nodiscard]] Token take(TokenKind kind, std::size_t length);

  std::string_view text_;
  Grammar grammar_;
  std::size_t at_ = 0;
};

/// line:column of an offset, both from 1, columns in bytes.
[[nodiscard]] std::string line_and_column(std::string_view text, std::size_t offset);

}  // namespace orbc::diff
