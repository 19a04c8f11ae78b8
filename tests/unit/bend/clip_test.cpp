#include "compiler/bend/clip.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <random>
#include <set>

using namespace orbc;
using namespace orbc::bend;
using geometry::Space;

namespace {

/// A sloped sheet of triangles around the point at distance `away` from the eye.
place::PlacedMesh sheet_mesh(Space space, double away, int cells) {
  place::PlacedMesh mesh;
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= cells; ++j) {
      const double x = 0.8 * i / cells - 0.41, y = 0.8 * j / cells - 0.38;
      mesh.floor.push_back(geometry::translation_by(space, away, 0) * geometry::translation_by(space, x, y) * geometry::Point());
      mesh.z.push_back(0.3 + 0.4 * x + 0.2 * y);
    }
  }
  const auto id = [&](int i, int j) { return static_cast<std::uint32_t>(i * (cells + 1) + j); };
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      mesh.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  return mesh;
}

using Bits = std::array<double, 4>;
Bits bits(const place::PlacedMesh& mesh, std::uint32_t v) { return {mesh.floor[v].w, mesh.floor[v].x, mesh.floor[v].y, mesh.z[v]}; }

}  // namespace

TEST_CASE("wedges around the eye divide a mesh without gap or overlap, vertex by vertex", "[bend]") {
  const Space space = GENERATE(Space::spherical, Space::euclidean, Space::hyperbolic);
  const double away = GENERATE(0.0, 0.2, 0.9);
  const int sheet = GENERATE(0, 1);
  if (sheet == 1 && space != Space::spherical) return;
  const auto mesh = sheet_mesh(space, away, 5);
  const std::vector<std::array<float, 2>> uv(mesh.floor.size());
  const auto net = edge_mesh(space, mesh, 0);
  const LogMap map{space, geometry::matrix(geometry::rotation(space, 0.3)), sheet};
  std::mt19937 random(7);
  std::vector<cover::Bearing> borders;
  for (int i = 0; i < 7; ++i) {
    const double angle = 2 * M_PI * (i + 0.8 * static_cast<double>(random() % 1000) / 1000) / 7;
    borders.push_back({std::cos(angle), std::sin(angle)});
  }
  // Inner edges are met twice, once in each direction; what is left is the border of the mesh.
  std::map<std::pair<Bits, Bits>, int> directed;
  std::size_t pieces = 0;
  for (std::size_t i = 0; i < borders.size(); ++i) {
    const cover::Wedge wedge{borders[i], borders[(i + 1) % borders.size()]};
    const auto part = clipped(wedge, map, net, uv);
    if (wedge_overlap(wedge, map, net) == WedgeOverlap::outside) CHECK(part->mesh.triangles.empty());
    CHECK(part->part.points.w.size() == part->mesh.floor.size());
    pieces += part->mesh.triangles.size();
    for (const auto& t : part->mesh.triangles) {
      for (int k = 0; k < 3; ++k) ++directed[{bits(part->mesh, t[k]), bits(part->mesh, t[(k + 1) % 3])}];
    }
  }
  CHECK(pieces >= mesh.triangles.size());
  int open = 0;
  for (const auto& [edge, count] : directed) {
    CHECK(count == 1);
    if (!directed.count({edge.second, edge.first})) ++open;
  }
  // The open edges are those of the mesh's own border, cut where borders pass; around the eye's axis the wedges' points there may differ in
  // the last bits.
  const int outer = 4 * 5 + static_cast<int>(borders.size());
  CHECK(open <= outer + (away < 0.5 ? 2 * static_cast<int>(borders.size()) : 0));
}

TEST_CASE("a part on a storey above stands on its head", "[bend]") {
  const auto mesh = sheet_mesh(Space::euclidean, 1, 2);
  const auto net = edge_mesh(Space::euclidean, mesh, 0);
  const auto part = on_storey({1, -1, 2.0}, Space::euclidean, net);
  CHECK(part->mesh.z[0] == 2.0 - mesh.z[0]);
  CHECK(part->part.low == Approx(2.0 - net.high));
  CHECK(part->part.points.z[3] == static_cast<float>(2.0 - mesh.z[3]));
}
