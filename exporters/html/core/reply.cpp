#include "exporters/html/core/reply.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

namespace orbc::html {

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') out += '\\', out += c;
    else if (byte < 0x20 || c == '<' || c == '>' || c == '&' || byte == 0x7f) out += fmt::format("\\u{:04x}", byte);
    else out += c;
  }
  return out += '"';
}

void Reply::separate() {
  if (!first_) json += ',';
  first_ = false;
}

Reply& Reply::open(char bracket) {
  separate();
  json += bracket;
  first_ = true;
  return *this;
}

Reply& Reply::close(char bracket) {
  json += bracket;
  first_ = false;
  return *this;
}

Reply& Reply::key(std::string_view name) {
  separate();
  json += quoted(name);
  json += ':';
  first_ = true;
  return *this;
}

Reply& Reply::value(std::string_view text) {
  separate();
  json += quoted(text);
  return *this;
}

Reply& Reply::value(bool truth) {
  separate();
  json += truth ? "true" : "false";
  return *this;
}

Reply& Reply::value(double number) {
  separate();
  json += std::isfinite(number) ? fmt::format("{}", number) : "null";
  return *this;
}

Reply& Reply::numbers(std::span<const double> list) {
  array();
  for (const double number : list) value(number);
  return end_array();
}

Reply& Reply::add_block(const char* type, const void* data, std::size_t count, std::size_t size) {
  while (bytes.size() % 8 != 0) bytes.push_back(0);  // typed arrays stand at multiples of their element's size
  object().key("type").value(type).key("at").value(bytes.size()).key("count").value(count).end_object();
  const std::size_t at = bytes.size();
  bytes.resize(at + count * size);
  if (count > 0) std::memcpy(bytes.data() + at, data, count * size);
  return *this;
}

}  // namespace orbc::html
