#include "compiler/mesh/primitives.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "compiler/mesh/analyse.h"

using namespace orbc;
using namespace orbc::mesh;
using std::numbers::pi;

namespace {

void is_sound(const Mesh& mesh, int euler, std::size_t triangles) {
  const auto found = analyse(mesh);
  CHECK(mesh.triangles.size() == triangles);
  CHECK(found.closed);
  CHECK_FALSE(found.inside_out);
  CHECK(found.euler == euler);
  CHECK(found.degenerate == 0);
  CHECK(found.crossings_known);
  CHECK(found.crossings == 0);
  REQUIRE(mesh.uv.size() == mesh.positions.size());
  for (const auto& uv : mesh.uv) CHECK((uv[0] >= 0 && uv[0] <= 1 && uv[1] >= 0 && uv[1] <= 1));
}

}  // namespace

TEST_CASE("primitives are closed, turned outwards and have the promised number of triangles", "[mesh]") {
  is_sound(make_sphere(2, 24, 12), 2, 2 * 24 * 11);
  is_sound(make_sphere(1, 3, 2), 2, 6);
  is_sound(make_cylinder(1, 3, 20, 5, 3), 2, 2 * 20 * 5 + 2 * 20 * (2 * 3 - 1));
  is_sound(make_cylinder(1, 3, 3, 1, 1), 2, 12);
  is_sound(make_box({1, 2, 3}, {2, 3, 5}), 2, 4 * (2 * 3 + 3 * 5 + 5 * 2));
  is_sound(make_box({1, 1, 1}, {1, 1, 1}), 2, 12);
  is_sound(make_beam(4, 0.1, 16, 2), 2, 4 * (16 * 2 + 2 * 2 + 2 * 16));
  is_sound(make_torus(1, 0.3, 20, 10), 0, 400);
  is_sound(make_torus_knot(2, 3, 1, 0.15, 200, 12), 0, 4800);
  is_sound(make_torus_knot(3, 7, 1, 0.04, 900, 8), 0, 14400);
}

TEST_CASE("a torus knot of 26,022 triangles exists for the speed scene", "[mesh]") {
  is_sound(make_torus_knot(2, 3, 0.15, 0.04, 4337, 3), 0, 26022);
}

TEST_CASE("volumes of primitives converge to their closed forms with the square of the step", "[mesh]") {
  const auto volume = [](const Mesh& mesh) { return analyse(mesh, {.crossings = false}).volume; };
  CHECK(volume(make_box({1, 2, 3})) == Approx(6).epsilon(1e-14));
  CHECK(volume(make_beam(5, 0.2)) == Approx(0.2).epsilon(1e-14));
  const auto converges = [&](auto&& make, double exact) {
    const double coarse = exact - volume(make(1)), fine = exact - volume(make(2));
    CHECK(coarse > 0);
    CHECK(coarse < 0.03 * exact);
    CHECK(coarse / fine == Approx(4).epsilon(0.05));
  };
  converges([](int n) { return make_sphere(1.5, 32 * n, 16 * n); }, 4 * pi / 3 * 1.5 * 1.5 * 1.5);
  converges([](int n) { return make_cylinder(0.5, 2, 32 * n); }, pi * 0.25 * 2);
  converges([](int n) { return make_torus(2, 0.5, 64 * n, 32 * n); }, 2 * pi * pi * 2 * 0.25);
  // Pappus: the tube of a knot has the volume of its cross-section times the length of its middle line.
  double length = 0;
  const int steps = 100000;
  for (int i = 0; i < steps; ++i) {
    const double t = 2 * pi * i / steps, r = 1 + 0.4 * std::cos(3 * t), dr = -1.2 * std::sin(3 * t);
    length += std::sqrt(dr * dr + 4 * r * r + 1.44 * std::cos(3 * t) * std::cos(3 * t)) * 2 * pi / steps;
  }
  converges([](int n) { return make_torus_knot(2, 3, 1, 0.1, 300 * n, 24 * n); }, pi * 0.01 * length);
}

TEST_CASE("primitives are centred and as large as they say", "[mesh]") {
  const auto knows = [](const Mesh& mesh, double x, double y, double z) {
    const auto found = analyse(mesh, {.crossings = false});
    CHECK(found.highest.x == Approx(x));
    CHECK(found.highest.y == Approx(y));
    CHECK(found.highest.z == Approx(z));
    CHECK(found.lowest.x == Approx(-x));
    CHECK(found.lowest.y == Approx(-y));
    CHECK(found.lowest.z == Approx(-z));
    CHECK(length(found.centroid) < 1e-12);
  };
  knows(make_sphere(0.7, 16, 8), 0.7, 0.7, 0.7);
  knows(make_cylinder(0.5, 3, 16), 0.5, 0.5, 1.5);
  knows(make_box({1, 2, 3}), 0.5, 1, 1.5);
  knows(make_torus(2, 0.5, 16, 16), 2.5, 2.5, 0.5);
  knows(make_beam(2, 0.1), 1, 0.05, 0.05);
}

TEST_CASE("the picture on a sphere is not mirrored: u grows eastwards, v southwards", "[mesh]") {
  const auto sphere = make_sphere(1, 36, 18);
  for (std::size_t i = 0; i < sphere.positions.size(); ++i) {
    const auto& p = sphere.positions[i];
    const auto& uv = sphere.uv[i];
    CHECK(std::acos(p.z) / pi == Approx(uv[1]).margin(1e-6));
    if (std::abs(p.z) > 0.99) continue;
    const double u = std::atan2(p.y, p.x) / (2 * pi);
    CHECK(std::abs(std::remainder(u - uv[0], 1)) < 1e-6);
  }
}
