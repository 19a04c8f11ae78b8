#include "compiler/geometry/line.h"

#include <catch2/catch.hpp>

#include "tests/unit/geometry/random_geometry.h"

namespace orbc::geometry {
namespace {

using testing::kSpaces;
using testing::Random;

TEST_CASE("a line runs through its points and has its left where a left-hander expects it", "[geometry]") {
  Random random(21);
  for (const Space space : kSpaces)
    for (int i = 0; i < 2000; ++i) {
      const Point p = random.point(space, 2), q = random.point(space, 2);
      if (distance(space, p, q) < 1e-2 || distance(space, p, q) > 3.0) continue;
      const Line line = line_through(space, p, q);
      CHECK(std::fabs(value_at(line, p)) < 1e-11);
      CHECK(std::fabs(value_at(line, q)) < 1e-11);
      CHECK(line.x * line.x + line.y * line.y + curvature(space) * line.w * line.w == Approx(1).epsilon(1e-12));
      // Left is the direction turned by +90° in the frame carried from the origin.
      const double phi = random.angle(), s = random.uniform(0.01, 1.5);
      const Isometry room_from_local = translation_to(space, p);
      const Tangent v = room_from_local * Tangent(0, std::cos(phi), std::sin(phi)),
                    left = room_from_local * Tangent(0, -std::sin(phi), std::cos(phi));
      const Line along = line_along(space, p, v);
      CHECK(signed_distance(space, along, point_along(space, p, left, s)) == Approx(s).epsilon(1e-10));
      CHECK(signed_distance(space, along, point_along(space, p, left, -s)) == Approx(-s).epsilon(1e-10));
      CHECK(std::fabs(value_at(along, point_along(space, p, v, s))) < 1e-11);
      CHECK(value_at(reversed(along), q) == -value_at(along, q));
    }
}

TEST_CASE("two lines meet in a point of both", "[geometry]") {
  Random random(22);
  for (const Space space : kSpaces)
    for (int i = 0; i < 2000; ++i) {
      const Point p = random.point(space, 1.5);
      const double phi = random.angle(), turn = random.uniform(0.01, 3.13);
      const Isometry room_from_local = translation_to(space, p);
      const Line a = line_along(space, p, room_from_local * Tangent(0, std::cos(phi), std::sin(phi)));
      const Line b = line_along(space, p, room_from_local * Tangent(0, std::cos(phi + turn), std::sin(phi + turn)));
      CHECK(distance(space, intersection(space, a, b), p) < 1e-11 / std::sin(turn));
    }
}

TEST_CASE("the foot of a point is the nearest point of the line", "[geometry]") {
  Random random(23);
  for (const Space space : kSpaces)
    for (int i = 0; i < 2000; ++i) {
      const Line line = random.line(space, 1.5);
      const Point x = random.point(space, 1.5), near = foot(space, line, x);
      CHECK(std::fabs(value_at(line, near)) < 1e-12);
      if (std::fabs(signed_distance(space, line, x)) > 1.5) continue;  // close to the pole of the line every point is nearest
      CHECK(distance(space, x, near) == Approx(std::fabs(signed_distance(space, line, x))).margin(1e-11));
    }
}

TEST_CASE("normalised_line leaves a hyperbolic line far away exact to its size", "[geometry]") {
  for (double d = 0; d <= 15; d += 2.5) {
    const Line line{std::sinh(d), -std::cosh(d), 0};
    const Line again = normalised_line(Space::hyperbolic, {3 * line.w, 3 * line.x, 0});
    CHECK(again.x == Approx(line.x).epsilon(1e-15 * std::exp(2 * d) + 1e-15));
  }
  CHECK(std::isnan(normalised_line(Space::hyperbolic, {2, 1, 1}).x));
}

}  // namespace
}  // namespace orbc::geometry
