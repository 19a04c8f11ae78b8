#pragma once
#include <string>
#include <string_view>

#include "compiler/base/diagnostic.h"

namespace orbc::notation {

/// The text of a symbol as plain characters. Invariant: characters are replaced, never moved, so that diagnostics find their places.
class SymbolText {
 public:
  static constexpr std::size_t kMaxBytes = 8192;  ///< 256 corners, each a fraction of seven-digit numbers in parentheses

  /// In: the place of the text in its file; without a source, diagnostics quote the text itself. Bytes after kMaxBytes are ignored.
  SymbolText(std::string_view text, SourceSpan span);

  std::u32string characters;
  std::size_t begin = 0, end = 0;  ///< of the characters without blanks around them
  bool respelled = false;          ///< not in the usual spelling: a note tells the author how it was read

  [[nodiscard]] std::u32string inner() const { return characters.substr(begin, end - begin); }
  [[nodiscard]] SourceSpan place(std::size_t from, std::size_t length) const;
  [[nodiscard]] SourceSpan whole() const;
  /// The author's text, or "this symbol" when it is long.
  [[nodiscard]] std::string quoted() const;
  [[nodiscard]] Diagnostic error(const std::string& code, const std::string& message, std::size_t from, std::size_t length,
                                 const std::string& hint = {}) const;
  /// An error of code notation.unexpected-character about the character at `at`, or about the end of the text.
  [[nodiscard]] Diagnostic unexpected(std::size_t at, const std::string& hint) const;

 private:
  void skip_quote();
  void make_plain();
  void trim();
  [[nodiscard]] std::string shown(std::size_t at) const;

  std::string text_;
  SourceSpan span_;
};

[[nodiscard]] inline bool is_blank(char32_t c) { return c == U' ' || c == U'\t' || c == U'\n' || c == U'\r'; }

}  // namespace orbc::notation
