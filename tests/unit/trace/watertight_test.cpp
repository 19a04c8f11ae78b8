#include <catch2/catch.hpp>

#include "tests/property/trace/laws.h"

using namespace orbc;
using namespace orbc::trace;
using namespace orbc::trace::testing;

TEST_CASE("no ray slips out of a closed surface at its vertices and edges", "[trace]") {
  for (const auto& space : {Space::spherical, Space::euclidean, Space::hyperbolic}) CHECK(leaks(space, 20'000, 1) == 0);
}

TEST_CASE("paths agree with numerical integration in the disk chart", "[trace]") {
  Random random;
  for (const auto& placed : {furnished(regular_room(Space::spherical, 3, 2), 30), furnished(regular_room(Space::euclidean, 4, 2), 30),
                             furnished(regular_room(Space::hyperbolic, 5, 2), 30), furnished(regular_room(Space::hyperbolic, 8, 4), 30)}) {
    const TraceScene scene = prepare(placed);
    for (int i = 0; i < 2; ++i) {
      const Point from = random_point(placed.polygon, random, 0.05);
      const Ray ray = ray_from(placed.polygon.space, {from, 15}, random_direction(placed.polygon.space, from, random, 0.8));
      FollowOptions options;
      options.max_bounces = 1000;
      options.max_length = 15;
      const Path path = follow(scene, ray, options);
      const auto end = position_at(placed.polygon.space, path.last_ray, path.hit.t);
      const auto integrated = integrate(placed, ray, 15, 2e-4L);
      INFO("curvature " << geometry::curvature(placed.polygon.space) << ", " << path.bounces << " bounces");
      CHECK(geometry::distance(placed.polygon.space, end.floor, integrated.floor) < 1e-8);
      CHECK(std::fabs(end.z - integrated.z) < 1e-10);
    }
  }
}

TEST_CASE("rays that leave a surface do not meet it again at once, and find what lies beyond", "[trace]") {
  for (const auto& space : {Space::spherical, Space::euclidean, Space::hyperbolic}) CHECK(wrong_departures(space, 3000, 2) == 0);
}
