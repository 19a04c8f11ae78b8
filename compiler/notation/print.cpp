#include "compiler/notation/print.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace orbc::notation {

std::string to_text(const Orbifold& orbifold) {
  if (orbifold.strip) return is_half_strip(orbifold) ? "*22∞" : "**";
  std::string text(1, '*');
  for (const Rational& corner : orbifold.corners) {
    const std::string number = to_string(corner);
    if (number.size() == 1) text += number;
    else fmt::format_to(std::back_inserter(text), "({})", number);
  }
  return text;
}

Orbifold canonical(const Orbifold& orbifold) {
  Orbifold best = orbifold;
  std::vector<Rational> corners = orbifold.corners;
  for (int side = 0; side < 2; ++side) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
      if (std::lexicographical_compare(corners.begin(), corners.end(), best.corners.begin(), best.corners.end())) best.corners = corners;
    }
    std::reverse(corners.begin(), corners.end());
  }
  return best;
}

bool operator==(const Orbifold& left, const Orbifold& right) { return left.strip == right.strip && left.corners == right.corners; }

}  // namespace orbc::notation
