#include "compiler/bend/log_map.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include "tests/support/instruction_sets.h"

using namespace orbc;
using namespace orbc::bend;
using geometry::Point;
using geometry::Space;

namespace {

PointColumns random_points(Space space, std::size_t count, double radius, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  PointColumns points;
  for (std::size_t i = 0; i < count; ++i) {
    const double r = radius * std::sqrt(unit(random)), phi = 2 * std::numbers::pi * unit(random);
    points.w.push_back(geometry::cos_k(space, r));
    points.x.push_back(geometry::sin_k(space, r) * std::cos(phi));
    points.y.push_back(geometry::sin_k(space, r) * std::sin(phi));
    points.z.push_back(static_cast<float>(unit(random)));
  }
  return points;
}

double ulps(float got, double want) {
  const float near = std::fabs(static_cast<float>(want));
  return std::fabs(got - want) / (std::nextafter(near, 1e38F) - near);
}

}  // namespace

TEST_CASE("the vector kernel agrees with its scalar twin to 4 ulp", "[bend]") {
  const Space space = GENERATE(Space::hyperbolic, Space::euclidean, Space::spherical);
  const int sheet = space == Space::spherical ? GENERATE(0, 1, 2, 3) : 0;
  double worst = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const PointColumns points = random_points(space, 1001, space == Space::spherical ? 1.5 : 1.2, seed);
    const double far = space == Space::spherical ? 0.05 * seed : 0.25 * seed;
    LogMap map{space, geometry::matrix(geometry::translation_by(space, far * std::cos(seed), far * std::sin(seed))), sheet};
    if (seed == 1) map.eye_from_copy = geometry::matrix(geometry::identity(space));
    std::vector<float> fast(3 * 1001), exact(3 * 1001);
    bend_points(map, points, 0, 1001, fast.data());
    for (std::size_t i = 0; i < 1001; ++i) {
      const auto want = bent_position(map, {points.w[i], points.x[i], points.y[i]}, points.z[i]);
      const double size = std::hypot(want.x, want.y);
      if (std::fabs(want.x) > 1e-4 * size) worst = std::max(worst, ulps(fast[3 * i], want.x));
      if (std::fabs(want.y) > 1e-4 * size) worst = std::max(worst, ulps(fast[3 * i + 1], want.y));
      CHECK(fast[3 * i + 2] == points.z[i]);
    }
    bend_points_scalar(map, points, 0, 1001, exact.data());
    // One block or many: a vertex has the same bits wherever the piece begins.
    std::vector<float> piece(3 * 500);
    bend_points(map, points, 301, 500, piece.data());
    CHECK(std::memcmp(piece.data(), fast.data() + 3 * 301, piece.size() * sizeof(float)) == 0);
  }
  CAPTURE(geometry::name(space), sheet, worst);
  CHECK(worst <= 4);
}

TEST_CASE("points near the eye's foot keep their place", "[bend]") {
  const Space space = GENERATE(Space::hyperbolic, Space::spherical);
  PointColumns points;
  for (double r : {0.0, 1e-20, 1e-12, 1e-7, 1e-4, 1e-3, 1e-2}) {
    points.w.push_back(geometry::cos_k(space, r));
    points.x.push_back(geometry::sin_k(space, r) * 0.6);
    points.y.push_back(geometry::sin_k(space, r) * 0.8);
    points.z.push_back(0.5F);
  }
  std::vector<float> out(3 * points.w.size());
  bend_points({space, geometry::matrix(geometry::identity(space)), 0}, points, 0, points.w.size(), out.data());
  const double radii[] = {0.0, 1e-20, 1e-12, 1e-7, 1e-4, 1e-3, 1e-2};
  for (std::size_t i = 0; i < points.w.size(); ++i) {
    CHECK(out[3 * i] == Approx(0.6 * radii[i]).epsilon(3e-7).margin(1e-30));
    CHECK(out[3 * i + 1] == Approx(0.8 * radii[i]).epsilon(3e-7).margin(1e-30));
  }
}

TEST_CASE("copies too far for float go the slow way and stay finite", "[bend]") {
  const PointColumns points = random_points(Space::hyperbolic, 100, 1, 7);
  for (double far : {25.0, 29.0, 33.0, 60.0, 300.0}) {
    const LogMap map{Space::hyperbolic, geometry::matrix(geometry::translation_by(Space::hyperbolic, far, 0)), 0};
    std::vector<float> out(300);
    bend_points(map, points, 0, 100, out.data());
    for (std::size_t i = 0; i < 100; ++i) CHECK(out[3 * i] == Approx(far).margin(1.01));
  }
}

TEST_CASE("a point of the sphere is seen again opposite at 2π − r", "[bend]") {
  const double r = 0.7;
  const Point p(std::cos(r), std::sin(r) * 0.6, std::sin(r) * 0.8);
  const auto matrix = geometry::matrix(geometry::identity(Space::spherical));
  const double pi = std::numbers::pi, reach[] = {r, -(2 * pi - r), 2 * pi + r, -(4 * pi - r)};
  for (int sheet = 0; sheet < 4; ++sheet) {
    const auto v = bent_position({Space::spherical, matrix, sheet}, p, 0.25);
    CHECK(v.x == Approx(0.6 * reach[sheet]).epsilon(1e-14));
    CHECK(v.y == Approx(0.8 * reach[sheet]).epsilon(1e-14));
    CHECK(v.z == 0.25);
  }
}

TEST_CASE("bent points have the same bits with every instruction set", "[bend]") {
  const Space space = GENERATE(Space::hyperbolic, Space::euclidean, Space::spherical);
  REQUIRE(orbc::testing::instruction_sets().size() >= 2);
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const PointColumns points = random_points(space, 1001, space == Space::spherical ? 1.5 : 1.2, seed);
    const double far = space == Space::spherical ? 0.05 * seed : 0.6 * seed;
    const LogMap map{space, geometry::matrix(geometry::translation_by(space, far * std::cos(seed), far * std::sin(seed))),
                     space == Space::spherical ? static_cast<int>(seed % 4) : 0};
    const auto made = orbc::testing::with_each_instruction_set([&] {
      std::vector<float> out(3 * 1001);
      bend_points(map, points, 0, 1001, out.data());
      return out;
    });
    for (std::size_t i = 1; i < made.size(); ++i) {
      INFO(geometry::name(space) << ", seed " << seed << ", " << orbc::testing::name_of(orbc::testing::instruction_sets()[i]));
      CHECK(std::memcmp(made[i].data(), made[0].data(), made[0].size() * sizeof(float)) == 0);
    }
  }
}
