#pragma once
#include <charconv>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#ifdef __EMSCRIPTEN__
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#endif

/// Numbers of texts, as std::from_chars and std::to_chars read and write them in any locale. The libc++ of emscripten 3.1.6 has neither for
/// floating-point numbers, so there they are made of other parts.
namespace orbc {

/// A number at the beginning of a text.
struct LeadingNumber {
  double value = 0;           ///< the nearest double; meaningless where it is out of range
  std::size_t length = 0;     ///< bytes that belong to it; 0: the text begins with no number
  bool out_of_range = false;  ///< too large for a double, or so small that it is 0
};

/// Reads a decimal number, without blanks or a plus before it.
[[nodiscard]] inline LeadingNumber leading_number(std::string_view text) {
  LeadingNumber read;
#ifdef __EMSCRIPTEN__  // its strtod rounds alike and knows one locale, but takes more
  const std::size_t first = !text.empty() && text[0] == '-' ? 1 : 0;
  const std::string terminated(text.substr(0, text.find_first_not_of("0123456789.eE+-")));
  if (terminated.size() <= first || terminated[first] == '+' || terminated[first] == '-') return read;
  char* end = nullptr;
  read.value = std::strtod(terminated.c_str(), &end);
  read.length = static_cast<std::size_t>(end - terminated.c_str());
  const std::string_view digits = std::string_view(terminated).substr(0, read.length);
  const bool is_zero = digits.substr(0, digits.find_first_of("eE")).find_first_of("123456789") == digits.npos;
  read.out_of_range = std::isinf(read.value) || (read.value == 0 && !is_zero);
#else
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), read.value);
  if (error == std::errc::invalid_argument) return read;
  read.length = static_cast<std::size_t>(end - text.data());
  read.out_of_range = error == std::errc::result_out_of_range;
#endif
  return read;
}

/// Writes the shortest text that reads back as the same value, without an exponent where that is no longer. In: 32 bytes of room.
/// Makes: the end of the text.
template <class Number>
[[nodiscard]] char* put_shortest(char* out, Number value) {
#ifdef __EMSCRIPTEN__
  if constexpr (std::numeric_limits<Number>::is_integer) return fmt::format_to(out, "{}", value);
  else {
    if (!std::isfinite(value) || value == 0) return fmt::format_to(out, "{}", value);
    // d1.d2d3…dn × 10^exponent from fmt's shortest text, which may have either form.
    const std::string text = fmt::format("{}", value < 0 ? -value : value);
    const std::size_t e = std::min(text.find('e'), text.size()), point = std::min(text.find('.'), e);
    std::string all = text.substr(0, point) + (point < e ? text.substr(point + 1, e - point - 1) : "");
    int exponent = static_cast<int>(point) - 1 + (e < text.size() ? std::atoi(text.c_str() + e + 1) : 0);
    const std::size_t zeros = all.find_first_not_of('0');
    all.erase(0, zeros);
    exponent -= static_cast<int>(zeros);
    all.erase(all.find_last_not_of('0') + 1);
    const int count = static_cast<int>(all.size());
    const std::string scientific =
        fmt::format("{}{}{}e{}{:02}", all[0], count > 1 ? "." : "", all.substr(1), exponent < 0 ? '-' : '+', std::abs(exponent));
    const std::size_t fixed_length = exponent < 0            ? static_cast<std::size_t>(count - exponent + 1)
                                     : exponent >= count - 1 ? static_cast<std::size_t>(exponent + 1)
                                                             : static_cast<std::size_t>(count + 1);
    if (value < 0) *out++ = '-';
    if (fixed_length > scientific.size()) return fmt::format_to(out, "{}", scientific);
    if (exponent < 0) return fmt::format_to(out, "0.{}{}", std::string(static_cast<std::size_t>(-exponent - 1), '0'), all);
    if (exponent >= count - 1) return fmt::format_to(out, "{:.0f}", std::fabs(static_cast<double>(value)));  // all its digits
    return fmt::format_to(out, "{}.{}", all.substr(0, static_cast<std::size_t>(exponent + 1)),
                          all.substr(static_cast<std::size_t>(exponent + 1)));
  }
#else
  return std::to_chars(out, out + 32, value).ptr;
#endif
}

}  // namespace orbc
