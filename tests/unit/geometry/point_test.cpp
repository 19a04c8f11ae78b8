#include "compiler/geometry/point.h"

#include <catch2/catch.hpp>

#include "tests/unit/geometry/random_geometry.h"

namespace orbc::geometry {
namespace {

using testing::kSpaces;
using testing::off_surface;
using testing::Random;
using testing::stretch;

constexpr double kDistanceEps = 0x1p-52;

double inner(Space space, const Ambient& p, const Ambient& q) {
  // The form that is positive on tangents.
  return curvature(space) * p.w * q.w + p.x * q.x + p.y * q.y;
}

TEST_CASE("distance is a metric that point_along walks at unit speed", "[geometry]") {
  Random random(11);
  for (const Space space : kSpaces)
    for (int i = 0; i < 2000; ++i) {
      const Point p = random.point(space), q = random.point(space), r = random.point(space);
      CHECK(distance(space, p, q) == distance(space, q, p));
      CHECK(distance(space, p, p) == 0);
      CHECK(distance(space, p, r) <= distance(space, p, q) + distance(space, q, r) + 1e-12);
      const double s = random.uniform(0, space == Space::spherical ? 3.1 : 4);
      const Point end = point_along(space, p, random.direction(space, p), s);
      CHECK(std::fabs(distance(space, p, end) - s) < 64 * kDistanceEps * stretch(space, p) * stretch(space, end));
    }
}

TEST_CASE("small distances keep their leading digits", "[geometry]") {
  for (const Space space : kSpaces)
    for (const double s : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
      // From the origin no coordinate is large, so the distance is right to its last digits.
      CHECK(distance(space, Point(), point_along(space, Point(), Tangent(0, 0.6, 0.8), s)) == Approx(s).epsilon(1e-15));
    }
  // Farther out the difference of coordinates carries only ulp(sinh r)/s.
  const Point p = point_from_log(Space::hyperbolic, {2, 1});
  const Tangent v = normalised_tangent(Space::hyperbolic, p, {0, 0.3, -1});
  for (const double s : {1e-3, 1e-6, 1e-9})
    CHECK(std::fabs(distance(Space::hyperbolic, p, point_along(Space::hyperbolic, p, v, s)) - s) < 16 * kDistanceEps * p.w);
}

TEST_CASE("antipodes of the sphere are π apart", "[geometry]") {
  Random random(12);
  for (int i = 0; i < 200; ++i) {
    const Point p = random.point(Space::spherical);
    CHECK(distance(Space::spherical, p, Point(-p.w, -p.x, -p.y)) == Approx(std::numbers::pi).epsilon(1e-15));
  }
}

TEST_CASE("direction_to and distance lead from P to Q", "[geometry]") {
  Random random(13);
  for (const Space space : kSpaces)
    for (int i = 0; i < 2000; ++i) {
      const double far = space == Space::spherical ? 3 : 3;
      const Point p = random.point(space, far), q = random.point(space, far);
      const double d = distance(space, p, q);
      if (d < 1e-3 || (space == Space::spherical && d > 3.1)) continue;
      const Point reached = point_along(space, p, direction_to(space, p, q), d);
      CHECK(distance(space, reached, q) < 1e-11 / std::min(1.0, d));
      const Point half = midpoint(space, p, q);
      CHECK(distance(space, p, half) == Approx(d / 2).epsilon(1e-10));
      CHECK(distance(space, half, q) == Approx(d / 2).epsilon(1e-10));
    }
}

TEST_CASE("direction_along is the derivative of point_along", "[geometry]") {
  Random random(14);
  for (const Space space : kSpaces)
    for (int i = 0; i < 500; ++i) {
      const Point p = random.point(space, 1.5);
      const Tangent v = random.direction(space, p);
      const double s = random.uniform(-1, 1), h = 1e-5;
      const Ambient quotient = (1 / (2 * h)) * (point_along(space, p, v, s + h) - point_along(space, p, v, s - h));
      const Tangent d = direction_along(space, p, v, s);
      CHECK(std::fabs(d.w - quotient.w) + std::fabs(d.x - quotient.x) + std::fabs(d.y - quotient.y) < 1e-8);
    }
}

TEST_CASE("normalised points and tangents stay on the surface to 1e-15 through long walks", "[geometry]") {
  Random random(15);
  for (const Space space : kSpaces) {
    Point p = random.point(space, 1);
    Tangent v = random.direction(space, p);
    for (int i = 0; i < 20000; ++i) {
      const double s = random.uniform(0, 0.7);
      const Point next = normalised_point(space, point_along(space, p, v, s));
      v = normalised_tangent(space, next, direction_along(space, p, v, s));
      p = next;
      // A turn now and then keeps the hyperbolic walk within 15 radii.
      if (i % 3 == 0) v = normalised_tangent(space, p, random.direction(space, p));
      if (space == Space::hyperbolic && p.w > std::cosh(15)) v = direction_to(space, p, Point());
      REQUIRE(off_surface(space, p) < 1e-15);
      const double scale = v.x * v.x + v.y * v.y + v.w * v.w;
      REQUIRE(std::fabs(inner(space, v, v) - 1) < 1e-15 * (1 + scale));
      if (space != Space::euclidean) REQUIRE(std::fabs(inner(space, p, v)) < 1e-15 * (1 + std::sqrt(scale) * stretch(space, p)));
      else REQUIRE(v.w == 0);
    }
  }
}

TEST_CASE("normalised_tangent undoes a drift off the tangent plane", "[geometry]") {
  Random random(16);
  for (const Space space : kSpaces)
    for (int i = 0; i < 1000; ++i) {
      const Point p = random.point(space, space == Space::hyperbolic ? 10 : 2);
      const Tangent v = random.direction(space, p);
      const Tangent fixed = normalised_tangent(space, p, random.uniform(0.1, 10) * v);
      CHECK(std::hypot(fixed.x - v.x, fixed.y - v.y) < 4 * kDistanceEps * stretch(space, p) * stretch(space, p));
    }
}

TEST_CASE("vectors cross and dot as they should", "[geometry]") {
  const Vector3 a{1, 2, 3}, b{-2, 0.5, 4};
  CHECK(dot(cross(a, b), a) == Approx(0).margin(1e-15));
  CHECK(cross({1, 0, 0}, {0, 1, 0}).z == 1);
  CHECK(length(normalised(a)) == Approx(1));
}

}  // namespace
}  // namespace orbc::geometry
