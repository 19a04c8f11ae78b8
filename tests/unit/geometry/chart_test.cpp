#include "compiler/geometry/chart.h"

#include <catch2/catch.hpp>

#include "tests/unit/geometry/random_geometry.h"

namespace orbc::geometry {
namespace {

using testing::kSpaces;
using testing::off_surface;
using testing::Random;
using testing::stretch;

constexpr double kEps = 0x1p-52;

TEST_CASE("the disk chart goes there and back", "[geometry]") {
  Random random(31);
  for (const Space space : kSpaces)
    for (int i = 0; i < 2000; ++i) {
      const Point p = random.point(space, space == Space::hyperbolic ? 8 : Random::reach(space));
      const Point back = point_from_disk(space, disk_from_point(space, p));
      CHECK(distance(space, p, back) < 16 * kEps * stretch(space, p));
      CHECK(off_surface(space, back) < 4 * kEps);
    }
}

TEST_CASE("the disk chart keeps its digits next to the antipode", "[geometry]") {
  for (const double gap : {1e-2, 1e-5, 1e-9}) {
    const Point p{-std::cos(gap), std::sin(gap) * 0.28, std::sin(gap) * 0.96};
    const std::complex<double> z = disk_from_point(Space::spherical, p);
    CHECK(std::abs(z) == Approx(1 / std::tan(gap / 2)).epsilon(1e-14));
    CHECK(distance(Space::spherical, point_from_disk(Space::spherical, z), p) < 4 * kEps);
  }
}

TEST_CASE("the log chart shows true distances and directions from the origin, to r = 15 in H²", "[geometry]") {
  Random random(32);
  for (const Space space : kSpaces)
    for (int i = 0; i < 2000; ++i) {
      const double r = random.uniform(0, space == Space::spherical ? 3.14 : 15), phi = random.angle();
      const Point p = point_from_log(space, std::polar(r, phi));
      CHECK(off_surface(space, p) < 4 * kEps);
      CHECK(distance(space, Point(), p) == Approx(r).epsilon(4e-15));
      CHECK(std::abs(log_from_point(space, p) - std::polar(r, phi)) < 1e-14 * (1 + r));
    }
  for (const Space space : kSpaces) {
    CHECK(log_from_point(space, Point()) == std::complex<double>(0, 0));
    CHECK(distance(space, point_from_log(space, 0), Point()) == 0);
  }
}

TEST_CASE("the gnomonic chart goes there and back and makes geodesics straight", "[geometry]") {
  Random random(33);
  for (const Space space : kSpaces)
    for (int i = 0; i < 2000; ++i) {
      const double far = space == Space::spherical ? 1.2 : 2;
      const Point p = random.point(space, far), q = random.point(space, far);
      const std::complex<double> klein = gnomonic_from_point(p);
      CHECK(distance(space, normalised_point(space, {1, klein.real(), klein.imag()}), p) <
            64 * kEps * stretch(space, p) * stretch(space, p));
      if (distance(space, p, q) < 0.1) continue;
      const Point m = point_along(space, p, direction_to(space, p, q), distance(space, p, q) * random.uniform(0.1, 0.9));
      const std::complex<double> a = gnomonic_from_point(p), b = gnomonic_from_point(q), c = gnomonic_from_point(m);
      CHECK(std::fabs(((b - a) * std::conj(c - a)).imag()) < 1e-11 * std::norm(b - a) + 1e-13);
    }
}

TEST_CASE("axial coordinates are arc lengths of feet on the axes, and their grid lines geodesics", "[geometry]") {
  Random random(34);
  const Line x_axis{0, 0, 1}, y_axis{0, -1, 0};
  for (const Space space : kSpaces)
    for (int i = 0; i < 2000; ++i) {
      const Point p = random.point(space, space == Space::spherical ? 1.4 : 3);
      const std::complex<double> uv = axial_from_point(space, p);
      const Point on_x = foot(space, x_axis, p), on_y = foot(space, y_axis, p);
      CHECK(std::fabs(uv.real()) == Approx(distance(space, Point(), on_x)).margin(1e-11));
      CHECK(std::fabs(uv.imag()) == Approx(distance(space, Point(), on_y)).margin(1e-11));
      CHECK(uv.real() * p.x >= 0);
      CHECK(distance(space, point_from_axial(space, uv), p) < 1e-10);
    }
}

}  // namespace
}  // namespace orbc::geometry
