#include "compiler/mesh/decimate.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "compiler/mesh/analyse.h"
#include "compiler/mesh/closest_point_tree.h"
#include "compiler/mesh/primitives.h"
#include "tests/unit/mesh/refined.h"

using namespace orbc;
using namespace orbc::mesh;
using orbc::mesh::test::refine_to_length;

TEST_CASE("decimation reaches the asked number and keeps a body closed, over uv seams too", "[mesh]") {
  for (const auto& mesh : {make_sphere(1, 64, 32), make_torus(1, 0.3), make_torus_knot(2, 3, 1, 0.2, 200, 16), make_cylinder(1, 2)}) {
    const auto before = analyse(mesh);
    for (const std::size_t count : {mesh.triangles.size() / 2, mesh.triangles.size() / 10}) {
      const auto coarse = decimate(mesh, {.triangles = count});
      CHECK(coarse.mesh.triangles.size() <= count);
      CHECK(coarse.mesh.triangles.size() + 2 >= count);
      const auto after = analyse(coarse.mesh);
      CHECK(after.closed);
      CHECK(after.euler == before.euler);
      CHECK(after.degenerate == 0);
      CHECK(after.volume == Approx(before.volume).epsilon(0.1));
      CHECK(coarse.error > 0);
      CHECK(coarse.error < 0.06);
      REQUIRE(coarse.mesh.uv.size() == coarse.mesh.positions.size());
    }
  }
}

TEST_CASE("decimation never exceeds the error it is allowed, and says what it reached", "[mesh]") {
  const auto mesh = make_sphere(1, 96, 48);
  std::size_t last = mesh.triangles.size();
  for (const double allowed : {0.001, 0.004, 0.016, 0.064}) {
    const auto coarse = decimate(mesh, {.max_error = allowed});
    CHECK(coarse.error <= allowed);
    CHECK(coarse.error > allowed / 10);
    CHECK(coarse.mesh.triangles.size() < last);
    last = coarse.mesh.triangles.size();
    const ClosestPointTree nearest(coarse.mesh);
    double largest = 0;
    for (const auto& p : mesh.positions) largest = std::max(largest, nearest.distance(p, 9));
    CHECK(largest == Approx(coarse.error));
  }
  CHECK(last < 300);
}

TEST_CASE("decimation gives the same bytes every time", "[mesh]") {
  const auto mesh = make_torus_knot(2, 3, 1, 0.2, 200, 16);
  const auto one = decimate(mesh, {.triangles = 1000}), two = decimate(mesh, {.triangles = 1000});
  CHECK(one.mesh.triangles == two.mesh.triangles);
  CHECK(one.mesh.uv == two.mesh.uv);
}

TEST_CASE("decimation of a flat sheet keeps its border, its uv and the border between its looks", "[mesh]") {
  Mesh square;
  square.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const auto& p : square.positions) square.uv.push_back({static_cast<float>(p.x), static_cast<float>(p.y)});
  square.triangles = {{0, 1, 4}, {0, 4, 5}, {1, 2, 3}, {1, 3, 4}};
  square.triangle_material = {0, 0, 1, 1};
  const auto fine = refine_to_length(square, 0.06);
  REQUIRE(fine);
  const auto coarse = decimate(*fine, {.triangles = 4});
  CHECK(coarse.mesh.triangles.size() == 4);
  CHECK(coarse.error < 1e-12);
  const auto found = analyse(coarse.mesh);
  CHECK(found.area == Approx(2));
  for (std::size_t t = 0; t < coarse.mesh.triangles.size(); ++t) {
    double x = 0;
    for (const auto v : coarse.mesh.triangles[t]) x += coarse.mesh.positions[v].x / 3;
    CHECK(coarse.mesh.triangle_material[t] == (x < 1 ? 0 : 1));
  }
  for (std::size_t v = 0; v < coarse.mesh.positions.size(); ++v) {
    CHECK(coarse.mesh.uv[v][0] == Approx(coarse.mesh.positions[v].x));
    CHECK(coarse.mesh.uv[v][1] == Approx(coarse.mesh.positions[v].y));
  }
}

TEST_CASE("decimation keeps to the uv of each side of a seam", "[mesh]") {
  // On a sphere uv belongs to the position, up to the seam u = 0 = 1: after decimation it still does.
  const auto coarse = decimate(make_sphere(1, 64, 32), {.triangles = 500});
  for (const auto& t : coarse.mesh.triangles) {
    float low = 2, high = -1;
    for (const auto v : t) {
      const auto& p = coarse.mesh.positions[v];
      const auto u = coarse.mesh.uv[v][0];
      if (std::abs(p.z) > 0.999) continue;
      CHECK(std::abs(std::remainder(std::atan2(p.y, p.x) / (2 * M_PI) - u, 1)) < 1e-5);
      low = std::min(low, u), high = std::max(high, u);
    }
    CHECK(high - low < 0.5f);
  }
}

TEST_CASE("decimation leaves alone what is no surface", "[mesh]") {
  Mesh fan;  // three sheets on one edge
  fan.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}};
  fan.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const auto fine = refine_to_length(fan, 0.1);
  REQUIRE(fine);
  const auto coarse = decimate(*fine, {.triangles = 10});
  CHECK(coarse.mesh.triangles.size() < fine->triangles.size());
  CHECK(analyse(coarse.mesh).area == Approx(analyse(*fine).area).epsilon(1e-9));
  CHECK(decimate(Mesh{}, {.triangles = 10}).mesh.triangles.empty());
}

TEST_CASE("a chain of decimations knows where its vertices come from", "[mesh]") {
  const auto mesh = make_torus_knot(2, 3, 1, 0.2, 200, 16);
  const auto chain = decimate_in_steps(mesh, {2000, 800, 300, 100});
  REQUIRE(chain.size() == 4);
  std::size_t count = mesh.triangles.size();
  for (const auto& step : chain) {
    CHECK(step.mesh.triangles.size() < count);
    CHECK(analyse(step.mesh).closed);
    REQUIRE(step.origin.size() == step.mesh.positions.size());
    for (std::size_t v = 0; v < step.origin.size(); ++v) CHECK(length(step.mesh.positions[v] - mesh.positions[step.origin[v]]) == 0);
    count = step.mesh.triangles.size();
  }
  CHECK(chain[3].mesh.triangles.size() <= 100);
}
