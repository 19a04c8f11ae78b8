#include "compiler/mesh_io/data_uri.h"

#include <cstdint>

namespace orbc::mesh_io {
namespace {

/// The six bits that a letter of base64 stands for (RFC 4648, also its alphabet for URLs); −1: none.
int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-' || c == ' ') return 62;
  return c == '/' || c == '_' ? 63 : -1;
}

std::optional<std::string> decode_base64(std::string_view text) {
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '\n' || c == '\r' || c == '=') continue;
    const int digit = base64_digit(c);
    if (digit < 0) return {};
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 255);
  }
  return bytes;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

std::string decode_percent(std::string_view text) {
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escaped = text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 && hex_digit(text[i + 2]) >= 0;
    bytes += escaped ? static_cast<char>(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2])) : text[i];
    if (escaped) i += 2;
  }
  return bytes;
}

}  // namespace

bool is_data_uri(std::string_view uri) { return uri.substr(0, 5) == "data:"; }

std::optional<std::string> decode_data_uri(std::string_view uri) {
  const auto comma = uri.find(',');
  if (!is_data_uri(uri) || comma == uri.npos) return {};
  const auto head = uri.substr(0, comma);
  const bool is_base64 = head.size() >= 7 && head.substr(head.size() - 7) == ";base64";
  const auto body = uri.substr(comma + 1);
  return is_base64 ? decode_base64(body) : std::optional<std::string>(decode_percent(body));
}

}  // namespace orbc::mesh_io
