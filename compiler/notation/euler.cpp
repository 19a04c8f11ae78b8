#include "compiler/notation/euler.h"

#include <algorithm>

namespace orbc::notation {

Rational euler_characteristic(const Orbifold& orbifold) {
  if (orbifold.strip) return 0;
  Rational sum = 1;
  for (const Rational& corner : orbifold.corners) sum += (1 / corner - 1) / 2;
  return sum;
}

bool is_orbifold(const Orbifold& orbifold) {
  return std::all_of(orbifold.corners.begin(), orbifold.corners.end(), [](const Rational& corner) { return denominator(corner) == 1; });
}

}  // namespace orbc::notation
