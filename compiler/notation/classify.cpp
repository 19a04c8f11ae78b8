#include "compiler/notation/classify.h"

#include <fmt/format.h>

#include "compiler/notation/euler.h"
#include "compiler/notation/parse.h"
#include "compiler/notation/print.h"

namespace orbc::notation {
namespace {

using geometry::Space;

Diagnostic bad(const Orbifold& orbifold, const std::string& reason, const std::string& hint, const SourceSpan& span) {
  return make_error("notation.bad-orbifold", to_text(orbifold) + " " + reason, hint, span);
}

std::string pair_of(const Rational& corner) { return to_text({{corner, corner}, false}); }

// A spherical triangle with angles A, B, C exists when A + B + C > π and π + A > B + C for each: the polar triangle's sides. For integer
// corners the second follows from the first.
bool closes_on_sphere(const std::vector<Rational>& corners) {
  for (std::size_t i = 0; i < 3; ++i)
    if (1 + 1 / corners[i] <= 1 / corners[(i + 1) % 3] + 1 / corners[(i + 2) % 3]) return false;
  return true;
}

}  // namespace

Result<Space> classify(const Orbifold& orbifold, const SourceSpan& span) {
  if (orbifold.strip) return Space::euclidean;
  const std::vector<Rational>& corners = orbifold.corners;
  if (corners.size() > static_cast<std::size_t>(kMaxCorners))
    return make_error("notation.too-many-corners",
                      fmt::format("{} corners are more than the {} that are supported", corners.size(), kMaxCorners), "", span);
  for (const Rational& corner : corners)
    if (corner <= 1 || corner > kMaxOrder)
      return make_error("notation.order-out-of-range",
                        fmt::format("a corner of order {} is not between 1 and {}", to_string(corner), kMaxOrder), "", span);
  if (corners.size() == 1)
    return bad(orbifold, "closes in no space of constant curvature: a single mirror cannot meet itself in a corner",
               fmt::format("one mirror alone is *; two mirrors with two equal corners are {}", pair_of(corners[0])), span);
  if (corners.size() == 2 && corners[0] != corners[1])
    return bad(orbifold, "closes in no space of constant curvature: two mirrors meet twice at the same angle",
               fmt::format("two mirror corners must have the same order: {} or {}", pair_of(corners[0]), pair_of(corners[1])), span);
  const Rational chi = euler_characteristic(orbifold);
  if (chi > 0 && corners.size() == 3 && !closes_on_sphere(corners))
    return bad(orbifold, "closes in no space of constant curvature: no spherical triangle has these angles",
               "each angle and a half turn must together exceed the other two angles", span);
  return chi > 0 ? Space::spherical : chi < 0 ? Space::hyperbolic : Space::euclidean;
}

}  // namespace orbc::notation
