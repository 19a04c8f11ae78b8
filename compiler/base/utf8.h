#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace orbc {

struct Utf8Character {
  char32_t code = 0;
  std::size_t length = 1;  ///< in bytes
};

/// The character that begins at byte `at` of a text; nothing when no well-formed UTF-8 sequence begins there (overlong forms, surrogates,
/// code points above U+10FFFF, truncated sequences).
/// In:     at < text.size().
/// Source: The Unicode Standard, table 3-7.
[[nodiscard]] inline std::optional<Utf8Character> decode_utf8(std::string_view text, std::size_t at = 0) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(at);
  if (lead < 0x80) return Utf8Character{lead, 1};
  const std::size_t length = lead >= 0xC2 && lead < 0xE0 ? 2 : lead >= 0xE0 && lead < 0xF0 ? 3 : lead >= 0xF0 && lead < 0xF5 ? 4 : 0;
  if (length == 0 || at + length > text.size()) return std::nullopt;
  char32_t code = lead & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0) != 0x80) return std::nullopt;
    code = code << 6 | (byte(at + i) & 0x3Fu);
  }
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  if (overlong || (code >= 0xD800 && code < 0xE000) || code > 0x10FFFF) return std::nullopt;
  return Utf8Character{code, length};
}

/// In: a code point up to U+10FFFF.
[[nodiscard]] inline std::string encode_utf8(char32_t code) {
  const auto tail = [&](int shift) { return static_cast<char>(0x80 | (code >> shift & 0x3F)); };
  if (code < 0x80) return {static_cast<char>(code)};
  if (code < 0x800) return {static_cast<char>(0xC0 | code >> 6), tail(0)};
  if (code < 0x10000) return {static_cast<char>(0xE0 | code >> 12), tail(6), tail(0)};
  return {static_cast<char>(0xF0 | code >> 18), tail(12), tail(6), tail(0)};
}

}  // namespace orbc
