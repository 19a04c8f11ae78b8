#pragma once
#include <string>
#include <string_view>

namespace orbc::notation {

inline constexpr char32_t kInfinity = U'\u221E';

/// The code points of UTF-8 text; bytes that are none stand for themselves above the range of Unicode, so that nothing matches them.
[[nodiscard]] std::u32string characters_of(std::string_view text);

/// The character that is meant by one of another width or shape: ＊ ⋆ ★ are *, ２ is 2, − is -, a no-break space is a blank. Others are
/// themselves.
[[nodiscard]] char32_t plain(char32_t c);

/// Plain characters as ASCII for translate.h: ∞ as "inf", Δ as "Delta", overlines as a minus before their digit, subscripts as letters and
/// digits; what has no place there becomes '?'.
[[nodiscard]] std::string ascii_of(const std::u32string& characters);

/// The digit that stands raised: 2 for ²; −1 for other characters.
[[nodiscard]] int raised_digit(char32_t c);

}  // namespace orbc::notation
