#include "compiler/notation/symbol_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/base/utf8.h"
#include "compiler/notation/characters.h"

namespace orbc::notation {
namespace {

constexpr std::size_t kQuotedCharacters = 40;

}  // namespace

SymbolText::SymbolText(std::string_view text, SourceSpan span)
    : characters(characters_of(text.substr(0, kMaxBytes))), text_(text.substr(0, kMaxBytes)), span_(std::move(span)) {
  if (!span_.source) span_ = {std::make_shared<SourceText>(SourceText{"notation", text_}), 1, 1, 1};
  else skip_quote();
  make_plain();
}

SourceSpan SymbolText::place(std::size_t from, std::size_t length) const {
  SourceSpan span = span_;
  if (span.line == 0) return span;
  span.column += from;
  span.length = length;
  return span;
}

SourceSpan SymbolText::whole() const { return place(begin, std::max<std::size_t>(end - begin, 1)); }

std::string SymbolText::quoted() const {
  if (characters.size() > kQuotedCharacters) return "this symbol";
  const std::size_t first = text_.find_first_not_of(" \t\n\r");
  if (first == std::string::npos) return "";
  return text_.substr(first, text_.find_last_not_of(" \t\n\r") - first + 1);
}

Diagnostic SymbolText::error(const std::string& code, const std::string& message, std::size_t from, std::size_t length,
                             const std::string& hint) const {
  return make_error(code, message, hint, place(from, length));
}

Diagnostic SymbolText::unexpected(std::size_t at, const std::string& hint) const {
  if (at >= characters.size()) return error("notation.unexpected-character", "the notation ends too early", at, 1, hint);
  return error("notation.unexpected-character", shown(at) + " does not belong into an orbifold notation", at, 1, hint);
}

std::string SymbolText::shown(std::size_t at) const {
  const char32_t c = characters[at];
  if (c >= kFirstByteCode) return fmt::format("byte {:02X}", static_cast<unsigned>(c - kFirstByteCode));
  if (c < 0x20 || (c >= 0x7F && c < 0xA0)) return fmt::format("control character {:02X}", static_cast<unsigned>(c));
  return "'" + encode_utf8(c) + "'";
}

// A span of a YAML scalar begins at its quotation mark, which is not part of the text.
void SymbolText::skip_quote() {
  std::string_view rest = span_.source->text;
  for (std::size_t line = 1; line < span_.line && !rest.empty(); ++line)
    rest.remove_prefix(std::min(rest.size(), rest.find('\n') == std::string_view::npos ? rest.size() : rest.find('\n') + 1));
  const std::u32string line = characters_of(rest.substr(0, std::min(rest.find('\n'), kMaxBytes)));
  if (span_.line == 0 || span_.column == 0 || span_.column > line.size()) return;
  const char32_t quote = line[span_.column - 1];
  if ((quote == U'"' || quote == U'\'') && (characters.empty() || characters[0] != quote)) ++span_.column;
}

void SymbolText::trim() {
  begin = 0;
  end = characters.size();
  while (begin < end && is_blank(characters[begin])) ++begin;
  while (end > begin && is_blank(characters[end - 1])) --end;
}

// Quotation marks around the whole text become blanks.
void SymbolText::make_plain() {
  constexpr std::u32string_view kOpening = U"\"'`$\u201C\u2018", kClosing = U"\"'`$\u201D\u2019";
  constexpr char32_t kUsualStar = 0x2217;  // ∗, the mathematical one
  for (char32_t& c : characters) {
    const char32_t meant = plain(c);
    respelled = respelled || (meant != c && c != kUsualStar);
    c = meant;
  }
  trim();
  if (end - begin < 2) return;
  const std::size_t mark = kOpening.find(characters[begin]);
  if (mark == std::u32string_view::npos || characters[end - 1] != kClosing[mark]) return;
  characters[begin] = characters[end - 1] = U' ';
  respelled = true;
  trim();
}

}  // namespace orbc::notation
