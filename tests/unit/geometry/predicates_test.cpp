#include "compiler/geometry/predicates.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <limits>

#include "tests/unit/geometry/random_geometry.h"

namespace orbc::geometry {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using testing::kSpaces;
using testing::Random;

Rational exact_determinant(const Ambient& p, const Ambient& q, const Ambient& x) {
  const Rational pw(p.w), px(p.x), py(p.y), qw(q.w), qx(q.x), qy(q.y), xw(x.w), xx(x.x), xy(x.y);
  return pw * (qx * xy - qy * xx) - px * (qw * xy - qy * xw) + py * (qw * xx - qx * xw);
}

double nudged(double v, int ulps) {
  for (; ulps > 0; --ulps) v = std::nextafter(v, std::numeric_limits<double>::infinity());
  for (; ulps < 0; ++ulps) v = std::nextafter(v, -std::numeric_limits<double>::infinity());
  return v;
}

std::vector<Point> regular_polygon(Space space, int n, double radius) {
  std::vector<Point> corners;
  for (int i = 0; i < n; ++i) corners.push_back(point_from_log(space, std::polar(radius, 2 * std::numbers::pi * i / n)));
  return corners;
}

TEST_CASE("side_of is the sign of the exact determinant, also for points a few ulps off the line", "[geometry]") {
  Random random(41);
  int on = 0, checked = 0;
  for (const Space space : kSpaces)
    for (int i = 0; i < 3000; ++i) {
      const double far = space == Space::hyperbolic ? 15 : Random::reach(space);
      const Point p = random.point(space, far), q = random.point(space, far);
      const Ambient between = random.uniform(-1, 2) * p + random.uniform(-1, 2) * q;
      const Ambient x{nudged(between.w, static_cast<int>(random.uniform(-3, 3))),
                      nudged(between.x, static_cast<int>(random.uniform(-3, 3))), between.y};
      const int expected = exact_determinant(p, q, x).sign();
      REQUIRE(static_cast<int>(side_of(p, q, x)) == expected);
      REQUIRE(static_cast<int>(side_of(q, p, x)) == -expected);
      REQUIRE(static_cast<int>(side_of(q, x, p)) == expected);
      ++checked, on += expected == 0;
    }
  CHECK(checked == 9000);
  CHECK(side_of({1, 0.1, 0.1}, {1, 0.3, 0.3}, {1, 0.7, 0.7}) == Side::on);
  CHECK(side_of({1, 0.1, 0.1}, {1, 0.3, 0.3}, {1, 0.7, nudged(0.7, 1)}) == Side::left);
  CHECK(side_of({1, 0.1, 0.1}, {1, 0.3, 0.3}, {1, 0.7, nudged(0.7, -1)}) == Side::right);
}

TEST_CASE("side_of is exact for tiny, huge and equal vectors", "[geometry]") {
  for (const double scale : {1e-90, 1e-30, 1.0, 1e30, 1e90}) {
    CHECK(side_of({scale, 0, 0}, {0, scale, 0}, {0, 0, scale}) == Side::left);
    CHECK(side_of({scale, scale, 0}, {2 * scale, 2 * scale, 0}, {0, 1, 0.5}) == Side::on);
  }
  CHECK(side_of({1, 0, 0}, {1, 1e-200, 0}, {1, 0, 1e-200}) == Side::left);
  CHECK(side_of({1, 0, 0}, {1, 1e-300, 0}, {1, 0, 1e-300}) == Side::left);
  CHECK(side_of({1, 0, 0}, {1, 0, 0}, {1, 5, 3}) == Side::on);
}

TEST_CASE("a polygon contains its centre, borders its corners, and nothing else", "[geometry]") {
  for (const Space space : kSpaces)
    for (int n = 3; n <= 12; ++n) {
      const std::vector<Point> outline = regular_polygon(space, n, 1);
      CHECK(is_convex(outline));
      CHECK(contains(outline, Point()) == Containment::inside);
      for (const Point& corner : outline) CHECK(contains(outline, corner) == Containment::on_border);
      CHECK(contains(outline, point_from_log(space, std::polar(1.01, 0.0))) == Containment::outside);
      CHECK(contains(outline, point_from_log(space, std::polar(0.99, 0.0))) == Containment::inside);
      const std::vector<Point> clockwise(outline.rbegin(), outline.rend());
      CHECK_FALSE(is_convex(clockwise));
    }
}

TEST_CASE("stars, dents and folded outlines are not convex", "[geometry]") {
  for (const Space space : kSpaces) {
    const std::vector<Point> five = regular_polygon(space, 5, 1), seven = regular_polygon(space, 7, 1);
    CHECK_FALSE(is_convex({five[0], five[2], five[4], five[1], five[3]}));
    CHECK_FALSE(is_convex({seven[0], seven[3], seven[6], seven[2], seven[5], seven[1], seven[4]}));
    CHECK_FALSE(is_convex({five[0], five[1], five[2], five[3], five[4], five[0], five[1], five[2], five[3]}));
    std::vector<Point> dented = five;
    dented[2] = point_from_log(space, std::polar(0.1, 4 * std::numbers::pi / 5));
    CHECK_FALSE(is_convex(dented));
    CHECK_FALSE(is_convex({five[0], five[1], five[1]}));
  }
}

TEST_CASE("the half sphere is the inside of an equator that carries points", "[geometry]") {
  const std::vector<Point> equator = {{0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {0, 0, -1}};
  CHECK(contains(equator, Point()) == Containment::inside);
  CHECK(contains(equator, Point(1e-300, 1, 0)) == Containment::inside);
  CHECK(contains(equator, Point(0, 0.6, 0.8)) == Containment::on_border);
  CHECK(contains(equator, Point(-1e-300, 1, 0)) == Containment::outside);
}

}  // namespace
}  // namespace orbc::geometry
