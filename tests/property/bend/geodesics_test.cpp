// Bent positions against geodesics integrated numerically: Runge–Kutta in the disk chart of the cover, from the eye's place, in the
// direction and over the length that the bent position says. Nothing of the formulas under test is used on the way. In the chart with ds =
// 2|dz|/(1 + κ|z|²) a geodesic of unit speed obeys z'' = 2κ z̄ z'²/(1 + κ|z|²).
#include <catch2/catch.hpp>
#include <random>

#include "compiler/bend/tessellate.h"
#include "tests/unit/bend/fixture.h"

using namespace orbc;
using namespace orbc::bend;
using namespace orbc::bend::test;
using Complex = std::complex<double>;

namespace {

struct State {
  Complex z, dz;
};

State change(double k, const State& s) { return {s.dz, 2 * k * std::conj(s.z) * s.dz * s.dz / (1 + k * std::norm(s.z))}; }

/// The end of the geodesic of length `length`; `far` is the largest |z| on the way.
Complex follow(double k, Complex z, Complex direction, double length, int steps, double& far) {
  State s{z, direction * ((1 + k * std::norm(z)) / 2)};
  const double h = length / steps;
  for (int i = 0; i < steps; ++i) {
    const State a = change(k, s), b = change(k, {s.z + h / 2 * a.z, s.dz + h / 2 * a.dz}),
                c = change(k, {s.z + h / 2 * b.z, s.dz + h / 2 * b.dz}), d = change(k, {s.z + h * c.z, s.dz + h * c.dz});
    s.z += h / 6 * (a.z + 2.0 * b.z + 2.0 * c.z + d.z);
    s.dz += h / 6 * (a.dz + 2.0 * b.dz + 2.0 * c.dz + d.dz);
    far = std::max(far, std::abs(s.z));
  }
  return s.z;
}

}  // namespace

TEST_CASE("bent positions are where integrated geodesics from the eye end", "[bend]") {
  const auto [corners, order, sheets] = GENERATE(table<int, int, int>({{5, 2, 0}, {3, 7, 0}, {3, 2, 3}}));
  const auto room = regular_room(corners, order);
  const Space space = room.polygon.space;
  const double k = geometry::curvature(space);
  auto copies = copies_of(room, 3);
  if (sheets > 0) copies = with_sheets(copies, 3, sheets);
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> unit(0, 1);
  double worst = 0;
  int compared = 0;
  for (int trial = 0; trial < (sheets > 0 ? 1200 : 400); ++trial) {
    const auto& copy = copies[random() % copies.size()];
    // The eye's frame may be turned, too.
    place::Camera eye;
    eye.room_from_eye =
        geometry::translation_to(space, polar(space, 0.4 * unit(random), 7 * unit(random))) * geometry::rotation(space, 7 * unit(random));
    eye.z = unit(random);
    const Point x = polar(space, 0.5 * unit(random), 7 * unit(random));
    const double height = unit(random);
    const CopyMap map{View::eye, {space, geometry::matrix(inverse(eye.room_from_eye) * copy.cover_from_room), copy.sheet}};
    const Vector3 bent = image_of(map, x, height), ray = bent - Vector3{0, 0, eye.z};
    // A straight ray of speed 1 in eye coordinates: its horizontal part is a geodesic of speed c, its height grows linearly.
    const double length_of_ray = length(ray), c = std::hypot(ray.x, ray.y) / length_of_ray, m = ray.z / length_of_ray;
    const Complex start = geometry::disk_from_point(space, eye.room_from_eye * Point());
    const Complex a = eye.room_from_eye.a, turn = 1.0 / (std::conj(a) * std::conj(a));  // the direction of f'(0) of the Möbius map
    const Complex direction = Complex(ray.x, ray.y) / std::hypot(ray.x, ray.y) * turn / std::abs(turn);
    double far = 0;
    const double arc = c * length_of_ray;
    const Complex end = follow(k, start, direction, arc, 4000, far);
    if (far > 6) continue;  // S²: the chart's own far point is too near for the integrator's step
    const Complex want = geometry::disk_from_point(space, copy.cover_from_room * x);
    worst = std::max(worst, std::abs(end - want) * 2 / (1 + k * std::norm(want)));
    CHECK(eye.z + m * length_of_ray == Approx(height).margin(1e-12));
    ++compared;
  }
  CHECK(compared > 150);
  CHECK(worst <= 1e-9);
}
