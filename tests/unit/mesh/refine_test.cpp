
#include <catch2/catch.hpp>
#include <cmath>

#include "compiler/mesh/analyse.h"
#include "compiler/mesh/primitives.h"
#include "tests/unit/mesh/refined.h"

using namespace orbc;
using namespace orbc::mesh;
using orbc::mesh::test::refine_to_length;

namespace {

double longest_edge(const Mesh& mesh) {
  double longest = 0;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, length(mesh.positions[t[k]] - mesh.positions[t[(k + 1) % 3]]));
  }
  return longest;
}

}  // namespace

TEST_CASE("refinement reaches the asked length and keeps a surface closed, over uv seams too", "[mesh]") {
  for (const auto& mesh : {make_sphere(1, 8, 5), make_box({1, 2, 3}, {1, 1, 1}), make_torus(1, 0.3, 7, 5), make_cylinder(1, 2, 6, 1, 1)}) {
    const auto before = analyse(mesh);
    for (const double edge : {0.5, 0.21, 0.1}) {
      const auto fine = refine_to_length(mesh, edge);
      REQUIRE(fine);
      CHECK(longest_edge(*fine) <= edge);
      const auto after = analyse(*fine);
      CHECK(after.closed);
      CHECK(after.euler == before.euler);
      CHECK(after.volume == Approx(before.volume).epsilon(1e-12));
      CHECK(after.area == Approx(before.area).epsilon(1e-12));
      CHECK(fine->uv.size() == fine->positions.size());
      CHECK(fine->triangles == refine_to_length(mesh, edge)->triangles);
    }
  }
}

TEST_CASE("refinement asks of each edge alone: part of a mesh can be refined without cracks", "[mesh]") {
  const auto mesh = make_sphere(1, 12, 8);
  const auto fine = refine(mesh, [](const auto& a, const auto& b) { return a.z + b.z > 0.8 && length(a - b) > 0.1; });
  REQUIRE(fine);
  CHECK(analyse(*fine).closed);
  CHECK(fine->triangles.size() > mesh.triangles.size());
}

TEST_CASE("refinement halves uv with its edge and keeps the look of triangles", "[mesh]") {
  Mesh square;
  square.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.uv = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  square.triangle_material = {3, 7};
  const auto fine = refine_to_length(square, 0.1);
  REQUIRE(fine);
  for (std::size_t i = 0; i < fine->positions.size(); ++i) {
    CHECK(fine->uv[i][0] == Approx(fine->positions[i].x).margin(1e-6));
    CHECK(fine->uv[i][1] == Approx(1 - fine->positions[i].y).margin(1e-6));
  }
  REQUIRE(fine->triangle_material.size() == fine->triangles.size());
  for (std::size_t t = 0; t < fine->triangles.size(); ++t) {
    geometry::Vector3 sum;
    for (const auto v : fine->triangles[t]) sum = sum + fine->positions[v];
    CHECK(fine->triangle_material[t] == (sum.y < sum.x ? 3 : 7));
  }
}

TEST_CASE("refinement that would need too much is refused, and the impossible ends", "[mesh]") {
  const auto refused = refine_to_length(make_sphere(1), 1e-4, 1'000'000);
  REQUIRE_FALSE(refused);
  CHECK(refused.error().front().code == "mesh.too-dense");
  // Edges at the resolution of doubles cannot be split further.
  Mesh tiny;
  tiny.positions = {{1, 1, 1}, {1 + 9e-16, 1, 1}, {1, 1 + 9e-16, 1}};
  tiny.triangles = {{0, 1, 2}};
  CHECK(refine(
      tiny, [](const auto&, const auto&) { return true; }, 1000000));
}
