#include "compiler/geometry/space.h"

#include <catch2/catch.hpp>
#include <string>

#include "tests/unit/geometry/random_geometry.h"

namespace orbc::geometry {
namespace {

TEST_CASE("generalised sine and cosine are one circle, line or hyperbola, and their inverses undo them", "[geometry]") {
  testing::Random random(51);
  for (const Space space : testing::kSpaces)
    for (int i = 0; i < 500; ++i) {
      const double s = random.uniform(-1.5, 1.5), k = curvature(space);
      CHECK(cos_k(space, s) * cos_k(space, s) + k * sin_k(space, s) * sin_k(space, s) == Approx(1).epsilon(1e-14));
      CHECK(tan_k(space, s) * cos_k(space, s) == Approx(sin_k(space, s)).epsilon(1e-14));
      CHECK(asin_k(space, sin_k(space, s)) == Approx(s).epsilon(1e-13));
      CHECK(atan_k(space, tan_k(space, s)) == Approx(s).epsilon(1e-13));
      CHECK(arc_k(space, cos_k(space, s), std::fabs(sin_k(space, s))) == Approx(std::fabs(s)).epsilon(1e-14));
    }
  CHECK(asin_k(Space::spherical, 1 + 1e-15) == Approx(std::numbers::pi / 2));
  CHECK(std::string(name(Space::hyperbolic)) == "hyperbolic");
}

}  // namespace
}  // namespace orbc::geometry
