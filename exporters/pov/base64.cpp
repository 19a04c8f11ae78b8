#include "exporters/pov/base64.h"

#include <algorithm>

namespace orbc::pov {

void write_base64(exporters::Pen& pen, std::string_view bytes) {
  static constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  constexpr std::size_t kBytesPerLine = 57;  // 76 letters
  for (std::size_t line = 0; line < bytes.size(); line += kBytesPerLine) {
    const std::size_t end = std::min(line + kBytesPerLine, bytes.size());
    char text[80];
    std::size_t n = 0;
    for (std::size_t i = line; i < end; i += 3) {
      const auto byte = [&](std::size_t k) { return k < end ? static_cast<unsigned>(static_cast<unsigned char>(bytes[k])) : 0u; };
      const unsigned bits = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
      text[n++] = kLetters[bits >> 18];
      text[n++] = kLetters[bits >> 12 & 63];
      text[n++] = i + 1 < end ? kLetters[bits >> 6 & 63] : '=';
      text[n++] = i + 2 < end ? kLetters[bits & 63] : '=';
    }
    pen << std::string_view(text, n) << '\n';
  }
}

}  // namespace orbc::pov
