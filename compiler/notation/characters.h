#pragma once
#include <string>
#include <string_view>

namespace orbc::notation {

inline constexpr char32_t kInfinity = U'\u221E';

/// Bytes that are no UTF-8 get codes from here on, above the range of Unicode.
inline constexpr char32_t kFirstByteCode = 0x110000;

/// The code points of a UTF-8 text; a byte that belongs to none becomes kFirstByteCode + byte.
[[nodiscard]] std::u32string characters_of(std::string_view text);

/// The plain form of a character of another width or shape: ＊ ⋆ ★ become *, ２ becomes 2, − becomes -, a no-break space becomes a blank.
/// Other characters stay as they are.
[[nodiscard]] char32_t plain(char32_t c);

/// Plain characters as ASCII, for translate.h: ∞ becomes "inf", Δ becomes "Delta", an overline becomes a minus before its digit, subscripts
/// become letters and digits; every other character becomes '?'.
[[nodiscard]] std::string ascii_of(const std::u32string& characters);

/// The digit of a superscript: 2 for ²; −1 for other characters.
[[nodiscard]] int raised_digit(char32_t c);

}  // namespace orbc::notation
