// Bytes that are not UTF-8 would make the whole file unreadable; they become U+FFFD. Titles and names come from authors.
#include "exporters/gltf/json.h"

namespace orbc::gltf {
namespace {

/// Length of the well-formed UTF-8 sequence at the start of `s` (Unicode, table 3-7), or 0.
std::size_t utf8_length(std::string_view s) {
  const auto byte = [&](std::size_t i) { return i < s.size() ? static_cast<unsigned char>(s[i]) : 0u; };
  const auto tail = [&](std::size_t i) { return (byte(i) & 0xC0u) == 0x80u; };
  const unsigned lead = byte(0), second = byte(1);
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead <= 0xDF) return tail(1) ? 2 : 0;
  if (lead >= 0xE0 && lead <= 0xEF) {
    const bool fits = (lead != 0xE0 || second >= 0xA0) && (lead != 0xED || second <= 0x9F);
    return fits && tail(1) && tail(2) ? 3 : 0;
  }
  if (lead >= 0xF0 && lead <= 0xF4) {
    const bool fits = (lead != 0xF0 || second >= 0x90) && (lead != 0xF4 || second <= 0x8F);
    return fits && tail(1) && tail(2) && tail(3) ? 4 : 0;
  }
  return 0;
}

}  // namespace

void Json::text(std::string_view value) {
  static constexpr char kHex[] = "0123456789abcdef";
  pen_ << '"';
  for (std::size_t i = 0; i < value.size();) {
    const unsigned char c = static_cast<unsigned char>(value[i]);
    const std::size_t length = utf8_length(value.substr(i));
    if (c == '"' || c == '\\') {
      pen_ << '\\' << value[i];
    } else if (c < 32) {
      pen_ << "\\u00" << kHex[c >> 4] << kHex[c & 15];
    } else if (length == 0) {
      pen_ << "\\ufffd";
    } else {
      pen_ << value.substr(i, length);
    }
    i += length == 0 ? 1 : length;
  }
  pen_ << '"';
}

}  // namespace orbc::gltf
