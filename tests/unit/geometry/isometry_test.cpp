#include "compiler/geometry/isometry.h"

#include <catch2/catch.hpp>

#include "tests/unit/geometry/random_geometry.h"

namespace orbc::geometry {
namespace {

using testing::kSpaces;
using testing::Random;
using testing::stretch;
using Complex = std::complex<double>;

constexpr double kIsometryEps = 0x1p-52;

TEST_CASE("isometries keep distances", "[geometry]") {
  Random random(1);
  for (const Space space : kSpaces)
    for (int i = 0; i < 2000; ++i) {
      const double far = Random::reach(space) / 2;
      const Isometry map = random.isometry(space, far);
      const Point p = random.point(space, far), q = random.point(space, far), mp = map * p, mq = map * q;
      CHECK(std::fabs(distance(space, mp, mq) - distance(space, p, q)) <
            64 * kIsometryEps * (stretch(space, mp) + stretch(space, mq)) *
                (space == Space::hyperbolic ? stretch(space, map * Point()) : 1));
      CHECK(testing::off_surface(space, mp) < 8 * kIsometryEps);
    }
}

TEST_CASE("the map is its Möbius formula on the disk chart and its matrix on ambient vectors", "[geometry]") {
  Random random(2);
  for (const Space space : kSpaces)
    for (int i = 0; i < 2000; ++i) {
      const Isometry map = random.isometry(space, space == Space::spherical ? 1.5 : 2);
      const Point p = random.point(space, 1.2), image = map * p;
      const double k = curvature(space);
      // The Möbius map acts on (x + iy)/(1 + w), which in E² is half the picture of the disk chart.
      const Complex half = Complex(p.x, p.y) / (1 + p.w), z = map.reversing ? std::conj(half) : half;
      const Complex denominator = -k * std::conj(map.b) * z + std::conj(map.a);
      const Complex expected = (map.a * z + map.b) / denominator, got = Complex(image.x, image.y) / (1 + image.w);
      if (std::abs(denominator) > 0.05) CHECK(std::abs(got - expected) < 1e-12 * (1 + std::norm(expected)));
      const Ambient by_matrix = matrix(map) * p;
      CHECK(std::fabs(by_matrix.w - image.w) + std::fabs(by_matrix.x - image.x) + std::fabs(by_matrix.y - image.y) <
            1e-13 * stretch(space, image) * stretch(space, p));
    }
}

TEST_CASE("composition and inverse obey the group laws, reversing maps included", "[geometry]") {
  Random random(3);
  for (const Space space : kSpaces)
    for (int i = 0; i < 2000; ++i) {
      const Isometry f = random.isometry(space, 1.4), g = random.isometry(space, 1.4), h = random.isometry(space, 1.4);
      const Point p = random.point(space, 1);
      const Point one = f * (g * p), two = (f * g) * p;
      CHECK(distance(space, one, two) < 1e-12);
      CHECK(difference((f * g) * h, f * (g * h)) < 1e-12);
      CHECK(difference(f * inverse(f), identity(space)) < 1e-13);
      CHECK(difference(inverse(f) * f, identity(space)) < 1e-13);
      CHECK(difference(inverse(f * g), inverse(g) * inverse(f)) < 1e-12);
      CHECK((f * g).reversing == (f.reversing != g.reversing));
      CHECK(std::fabs(std::norm(f.a) + curvature(space) * std::norm(f.b) - 1) < 1e-13);
    }
}

TEST_CASE("difference sees through the common sign and tells reversing maps apart", "[geometry]") {
  const Isometry turn = rotation(Space::hyperbolic, 1);
  CHECK(difference(turn, Isometry{turn.space, -turn.a, -turn.b, false}) == 0);
  CHECK(difference(rotation(Space::spherical, 2 * std::numbers::pi), identity(Space::spherical)) < 1e-15);
  CHECK(std::isinf(difference(turn, Isometry{turn.space, turn.a, turn.b, true})));
}

TEST_CASE("a reflection is an involution that fixes its line and swaps its sides", "[geometry]") {
  Random random(4);
  for (const Space space : kSpaces)
    for (int i = 0; i < 2000; ++i) {
      const Line line = random.line(space, space == Space::spherical ? 3 : 2);
      const Isometry mirror = reflection(space, line);
      CHECK(mirror.reversing);
      CHECK(difference(mirror * mirror, identity(space)) < 1e-12);
      const Point p = random.point(space, 1.5), on = foot(space, line, p);
      CHECK(distance(space, mirror * on, on) < 2e-13);
      CHECK(value_at(line, mirror * p) == Approx(-value_at(line, p)).margin(1e-12));
      // The image line of the mirror itself is the mirror; its left is now where its right was.
      const Line image = mirror * line;
      CHECK(std::fabs(image.w + line.w) + std::fabs(image.x + line.x) + std::fabs(image.y + line.y) < 1e-12);
    }
}

TEST_CASE("the image of a line keeps left left", "[geometry]") {
  Random random(5);
  for (const Space space : kSpaces)
    for (int i = 0; i < 2000; ++i) {
      const Isometry map = random.isometry(space, 1.5);
      const Line line = random.line(space, 1.5), image = map * line;
      const Point p = random.point(space, 1.5);
      CHECK(value_at(image, map * p) == Approx(value_at(line, p)).margin(1e-11));
      CHECK(image.x * image.x + image.y * image.y + curvature(space) * image.w * image.w == Approx(1).margin(1e-11));
      // Reflecting in the image is moving back, reflecting, and moving on.
      CHECK(difference(reflection(space, image), map * reflection(space, line) * inverse(map)) < 1e-11);
    }
}

TEST_CASE("tangents are carried along with their points", "[geometry]") {
  Random random(6);
  for (const Space space : kSpaces)
    for (int i = 0; i < 1000; ++i) {
      const Isometry map = random.isometry(space, 1.2);
      const Point p = random.point(space, 1.2);
      const Tangent v = random.direction(space, p);
      const double s = random.uniform(-1, 1);
      CHECK(distance(space, map * point_along(space, p, v, s), point_along(space, map * p, map * v, s)) < 1e-12);
    }
}

TEST_CASE("translations move the origin without turning, also next to the antipode", "[geometry]") {
  Random random(7);
  for (const Space space : kSpaces)
    for (int i = 0; i < 500; ++i) {
      const Point p = random.point(space);
      const Isometry map = translation_to(space, p);
      CHECK(distance(space, map * Point(), p) < 4 * kIsometryEps * stretch(space, p));
      // The axis goes through the origin and P: its direction at the origin is carried to its direction at P.
      const double rho = std::hypot(p.x, p.y);
      const Tangent start(0, p.x / rho, p.y / rho), end = direction_along(space, Point(), start, distance(space, Point(), p)),
                                                    got = map * start;
      CHECK(std::fabs(got.w - end.w) + std::fabs(got.x - end.x) + std::fabs(got.y - end.y) < 16 * kIsometryEps * stretch(space, p));
      CHECK(difference(map, translation_by(space, start.x * distance(space, Point(), p), start.y * distance(space, Point(), p))) <
            16 * kIsometryEps * stretch(space, p));
    }
  for (const double gap : {1e-1, 1e-4, 1e-8, 1e-12, 1e-15}) {
    const Point p = {-std::cos(gap), std::sin(gap) * 0.6, std::sin(gap) * -0.8};
    const Isometry map = translation_to(Space::spherical, p);
    CHECK(distance(Space::spherical, map * Point(), p) < 1e-15);
    CHECK(std::norm(map.a) + std::norm(map.b) == Approx(1).epsilon(1e-15));
    CHECK(std::abs(map.a) == Approx(gap / 2).epsilon(1e-3));
  }
}

TEST_CASE("translation_by by nothing is the identity", "[geometry]") {
  for (const Space space : kSpaces) CHECK(difference(translation_by(space, 0, 0), identity(space)) == 0);
}

TEST_CASE("renormalised products of thousands of factors stay isometries", "[geometry]") {
  Random random(8);
  for (const Space space : kSpaces) {
    // Steps to and fro, so that the product stays near while the rounding adds up.
    Isometry product = identity(space);
    for (int i = 0; i < 5000; ++i) {
      const Isometry step = translation_by(space, random.uniform(0, 0.4), random.uniform(-0.3, 0.3)) * rotation(space, random.angle());
      product = renormalised(product * step);
      if (i % 2) product = renormalised(product * inverse(step));
      if (std::abs(product.b) > 20) product = identity(space);
      REQUIRE(std::fabs(std::norm(product.a) + curvature(space) * std::norm(product.b) - 1) <
              8 * kIsometryEps * (1 + std::norm(product.b)));
    }
  }
}

TEST_CASE("far hyperbolic translations keep the digits that a matrix loses", "[geometry]") {
  for (double r = 1; r <= 15; r += 1) {
    const Isometry there = translation_by(Space::hyperbolic, r, 0), back = translation_by(Space::hyperbolic, -r, 0);
    CHECK(difference(there * back, identity(Space::hyperbolic)) < kIsometryEps * std::exp(r));
    CHECK(distance(Space::hyperbolic, there * Point(), Point()) == Approx(r).epsilon(1e-15));
  }
}

}  // namespace
}  // namespace orbc::geometry
