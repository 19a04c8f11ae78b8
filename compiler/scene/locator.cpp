// Code points are counted by their first bytes; a table every 256 bytes keeps a 4 MB line from costing quadratic time.
#include "compiler/scene/locator.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/base/utf8.h"

namespace orbc::scene {
namespace {

constexpr std::size_t kBlockBytes = 256;

bool starts_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

bool printable(char32_t c) {
  return c == '\t' || c == '\n' || c == '\r' || (c >= 0x20 && c < 0x7F) || c == 0x85 || (c >= 0xA0 && c < 0xFFFE && c != 0xFEFF) ||
         c >= 0x10000;
}

}  // namespace

Locator::Locator(std::shared_ptr<const SourceText> source) : source_(std::move(source)), line_starts_{0} {
  const std::string& text = source_->text;
  std::size_t characters = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (i % kBlockBytes == 0) characters_.push_back(characters);
    if (starts_character(text[i])) ++characters;
    if (text[i] == '\n') line_starts_.push_back(i + 1);
  }
  if (text.size() % kBlockBytes == 0) characters_.push_back(characters);
}

std::size_t Locator::characters_before(std::size_t offset) const {
  const std::string& text = source_->text;
  std::size_t count = characters_[offset / kBlockBytes];
  for (std::size_t i = offset / kBlockBytes * kBlockBytes; i < offset; ++i) count += starts_character(text[i]);
  return count;
}

SourceSpan Locator::span(std::size_t begin, std::size_t end) const {
  begin = std::min(begin, text().size());
  end = std::clamp(end, begin, text().size());
  const auto line = std::upper_bound(line_starts_.begin(), line_starts_.end(), begin) - line_starts_.begin();
  const std::size_t line_start = line_starts_[static_cast<std::size_t>(line) - 1];
  const std::size_t before = characters_before(begin);
  return {source_, static_cast<std::size_t>(line), before - characters_before(line_start) + 1,
          std::max<std::size_t>(1, characters_before(end) - before)};
}

SourceSpan Locator::at(std::size_t offset) const { return span(offset, offset + 1); }

SourceSpan Locator::token_at(std::size_t offset) const {
  offset = std::min(offset, text().size());
  return span(offset, std::min(text().find_first_of(" \t\r\n,]}", offset), text().size()));
}

SourceSpan Locator::scalar_at(std::size_t offset, std::string_view value) const {
  offset = std::min(offset, text().size());
  const std::string_view rest = text().substr(offset);
  if (!value.empty() && rest.substr(0, value.size()) == value) return span(offset, offset + std::min(value.size(), value.find('\n')));
  if (rest.empty() || (rest[0] != '"' && rest[0] != '\'')) return at(offset);
  for (std::size_t i = 1; i < rest.size() && rest[i] != '\n'; ++i) {
    if (rest[i] == rest[0]) return span(offset, offset + i + 1);
    if (rest[i] == '\\' && rest[0] == '"') ++i;
  }
  return at(offset);
}

bool Locator::quote_is_closed(std::size_t offset) const {
  if (offset >= text().size()) return true;
  const char quote = text()[offset];
  if (quote != '"' && quote != '\'') return true;
  for (std::size_t i = offset + 1; i < text().size(); ++i) {
    if (text()[i] == '\\' && quote == '"') ++i;
    else if (text()[i] != quote) continue;
    else if (quote == '\'' && i + 1 < text().size() && text()[i + 1] == '\'') ++i;  // '' stands for one quote
    else return true;
  }
  return false;
}

std::optional<Diagnostic> Locator::first_bad_character() const {
  for (std::size_t i = 0; i < text().size();) {
    const auto decoded = decode_utf8(text(), i);
    if (!decoded)
      return make_error("scene.not-utf8", fmt::format("byte {} (0x{:02X}) is not UTF-8", i + 1, static_cast<unsigned char>(text()[i])),
                        "save the file with the encoding UTF-8", at(i));
    if (!printable(decoded->code))
      return make_error("scene.bad-character",
                        fmt::format("the character U+{:04X} may not stand in a scene", static_cast<unsigned>(decoded->code)),
                        "remove it; an editor may show it as nothing", at(i));
    i += decoded->length;
  }
  return std::nullopt;
}

}  // namespace orbc::scene
