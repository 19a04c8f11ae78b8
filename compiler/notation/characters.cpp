#include "compiler/notation/characters.h"

#include "compiler/base/utf8.h"

namespace orbc::notation {

std::u32string characters_of(std::string_view text) {
  std::u32string characters;
  for (std::size_t i = 0; i < text.size();) {
    const auto character = decode_utf8(text, i);
    characters += character ? character->code : kFirstByteCode + static_cast<unsigned char>(text[i]);
    i += character ? character->length : 1;
  }
  return characters;
}

char32_t plain(char32_t c) {
  if (c >= 0xFF01 && c <= 0xFF5E) return c - 0xFF01 + U'!';  // full-width forms of ASCII
  switch (c) {
    case 0x22C6: case 0x2605: case 0x2606: case 0x2731: case 0x2733: case 0x204E: case 0xFE61: case 0x2217: return U'*';
    case 0x2212: case 0x2010: case 0x2011: case 0x2013: return U'-';
    case 0x00B7: case 0x2022: case 0x2219: case 0x22C5: return U'.';
    case 0x00A0: case 0x2009: case 0x200A: case 0x202F: case 0x3000: return U' ';
    case 0x2080: case 0x2081: case 0x2082: case 0x2083: case 0x2084:
    case 0x2085: case 0x2086: case 0x2087: case 0x2088: case 0x2089: return c - 0x2080 + U'0';
    default: return c;
  }
}

std::string ascii_of(const std::u32string& characters) {
  std::string text;
  for (const char32_t c : characters) {
    switch (c) {
      case kInfinity: text += "inf"; break;
      case 0x0394: case 0x2206: case 0x25B3: text += "Delta"; break;
      case 0x0304: case 0x0305: text.insert(text.empty() ? 0 : text.size() - 1, 1, '-'); break;
      case 0x2095: text += 'h'; break;
      case 0x1D65: text += 'v'; break;
      case 0x00D7: text += 'x'; break;
      case U'\n': case U'\r': text += ' '; break;
      default: text += c < 0x7F ? static_cast<char>(c) : '?';
    }
  }
  return text;
}

int raised_digit(char32_t c) {
  if (c == 0x00B9) return 1;
  if (c == 0x00B2 || c == 0x00B3) return static_cast<int>(c - 0x00B0);
  if (c == 0x2070 || (c >= 0x2074 && c <= 0x2079)) return static_cast<int>(c - 0x2070);
  return -1;
}

}  // namespace orbc::notation
