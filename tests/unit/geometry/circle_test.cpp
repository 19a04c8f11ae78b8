#include "compiler/geometry/circle.h"

#include <catch2/catch.hpp>

#include "tests/unit/geometry/random_geometry.h"

namespace orbc::geometry {
namespace {

TEST_CASE("a bounding circle contains its points, and touches one of them", "[geometry]") {
  testing::Random random(41);
  for (const Space space : testing::kSpaces) {
    for (int trial = 0; trial < 20; ++trial) {
      std::vector<Point> points;
      for (int i = 0; i < 6; ++i) points.push_back(random.point(space, 1.2));
      const Circle circle = bounding_circle(space, points);
      double farthest = 0;
      for (const Point& p : points) farthest = std::max(farthest, distance(space, circle.centre, p));
      CHECK(circle.radius == farthest);
    }
  }
}

TEST_CASE("points that balance each other on the sphere are bounded from the origin", "[geometry]") {
  const Circle circle = bounding_circle(Space::spherical, {{0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {0, 0, -1}});
  CHECK(circle.centre.w == 1);
  CHECK(circle.radius == Approx(std::numbers::pi / 2));
  CHECK(bounding_circle(Space::hyperbolic, {}).radius == 0);
}

}  // namespace
}  // namespace orbc::geometry
