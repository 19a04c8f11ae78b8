#include "compiler/cover/copy.h"

namespace orbc::cover {

std::string to_string(const Word& word) {
  std::string text;
  for (const std::uint8_t wall : word) {
    if (!text.empty()) text += ' ';
    text += std::to_string(wall + 1);
  }
  return text;
}

}  // namespace orbc::cover
