#include "compiler/mesh_io/tokens.h"

#include <charconv>
#include <utility>

#include "compiler/base/number_text.h"

namespace orbc::mesh_io {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f' || c == '\0'; }

void append_utf8(std::string& out, std::uint32_t code) {
  const auto tail = [&](int shift) { out += static_cast<char>(0x80 | (code >> shift & 0x3f)); };
  if (code < 0x80) {
    out += static_cast<char>(code);
  } else if (code < 0x800) {
    out += static_cast<char>(0xc0 | code >> 6);
    tail(0);
  } else if (code < 0x10000) {
    out += static_cast<char>(0xe0 | code >> 12);
    tail(6);
    tail(0);
  } else {
    out += static_cast<char>(0xf0 | code >> 18);
    tail(12);
    tail(6);
    tail(0);
  }
}

/// In: UTF-16 without its byte order mark. Surrogates without a partner become U+FFFD.
std::string utf8_from_utf16(std::string_view bytes, bool big_endian) {
  const auto unit = [&](std::size_t i) {
    const auto low = static_cast<unsigned char>(bytes[i + (big_endian ? 1 : 0)]),
               high = static_cast<unsigned char>(bytes[i + (big_endian ? 0 : 1)]);
    return static_cast<std::uint32_t>(high << 8 | low);
  };
  std::string text;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    std::uint32_t code = unit(i);
    if (code >= 0xd800 && code < 0xdc00 && i + 3 < bytes.size() && unit(i + 2) >= 0xdc00 && unit(i + 2) < 0xe000) {
      code = 0x10000 + (code - 0xd800) * 0x400 + (unit(i + 2) - 0xdc00);
      i += 2;
    } else if (code >= 0xd800 && code < 0xe000) {
      code = 0xfffd;
    }
    append_utf8(text, code);
  }
  return text;
}

bool has_lone_carriage_return(std::string_view text) {
  for (auto at = text.find('\r'); at != text.npos; at = text.find('\r', at + 1)) {
    // One at the very end may be half of a line end that was cut off.
    if (at + 1 < text.size() && text[at + 1] != '\n' && text[at + 1] != '\r') return true;
  }
  return false;
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (auto& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return lower;
}

DecodedText decode_text(std::string_view bytes) {
  if (bytes.substr(0, 3) == "\xef\xbb\xbf") bytes.remove_prefix(3);
  DecodedText decoded{bytes, {}};
  const bool little = bytes.substr(0, 2) == "\xff\xfe", big = bytes.substr(0, 2) == "\xfe\xff";
  if (little || big) decoded.changed = utf8_from_utf16(bytes.substr(2), big);
  if (!has_lone_carriage_return(decoded.text())) return decoded;
  std::string text(decoded.text());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n')) text[i] = '\n';
  }
  decoded.changed = std::move(text);
  return decoded;
}

std::string_view Tokens::word() {
  std::size_t n = 0;
  while (n < rest_.size() && rest_[n] != '\n' && !is_blank(rest_[n])) ++n;
  const auto found = rest_.substr(0, n);
  rest_.remove_prefix(n);
  return found;
}

std::string_view Tokens::next_in_line() {
  std::size_t n = 0;
  while (n < rest_.size() && is_blank(rest_[n])) ++n;
  rest_.remove_prefix(n);
  return word();
}

std::string_view Tokens::rest_of_line() {
  const auto end = rest_.find('\n');
  auto found = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (end != std::string_view::npos) ++line_;
  while (!found.empty() && is_blank(found.front())) found.remove_prefix(1);
  while (!found.empty() && is_blank(found.back())) found.remove_suffix(1);
  return found;
}

std::string_view Tokens::next(bool comments) {
  while (true) {
    const auto found = next_in_line();
    if (!found.empty() && !(comments && found.front() == '#')) return found;
    if (rest_.empty()) return {};
    rest_of_line();
  }
}

std::optional<double> to_number(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const LeadingNumber read = leading_number(word);
  if (word.empty() || read.length != word.size()) return {};
  // Too small for a double is 0 to any mesh; too large stays an error of the caller's range check.
  if (read.out_of_range) return word.find("e-") != word.npos || word.find("E-") != word.npos ? 0.0 : 1e308;
  return read.value;
}

std::optional<std::int64_t> to_integer(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  std::int64_t value = 0;
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || result.ec != std::errc() || result.ptr != word.data() + word.size()) return {};
  return value;
}

}  // namespace orbc::mesh_io
