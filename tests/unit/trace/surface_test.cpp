#include <catch2/catch.hpp>

#include "tests/unit/trace/support.h"

using namespace orbc;
using namespace orbc::trace;
using namespace orbc::trace::testing;

TEST_CASE("the checker of a floor follows the axial grid", "[trace]") {
  auto placed = furnished(regular_room(Space::hyperbolic, 5, 2));
  place::PlacedMesh floor;
  floor.kind = place::PartKind::floor;
  floor.style = {0};
  placed.parts.push_back(floor);
  place::SurfaceStyle look;
  look.material.pattern = scene::Pattern::checker;
  look.material.color = {1, 1, 1};
  look.material.second = {0, 0, 0};
  look.material.cell = 0.25;
  placed.styles.push_back(look);
  const TraceScene scene = prepare(placed);
  for (const auto& [u, v, second] :
       {std::tuple{0.1, 0.1, false}, {0.3, 0.1, true}, {-0.1, 0.1, true}, {-0.1, -0.1, false}, {0.3, 0.4, false}}) {
    const Ray ray = ray_from(Space::hyperbolic, {geometry::point_from_axial(Space::hyperbolic, {u, v}), 0.5}, {{0, 0, 0}, -1});
    const SurfacePoint point = surface_at(scene, ray, closest(scene, ray));
    CHECK(point.kind == place::PartKind::floor);
    CHECK(point.second_color == second);
    CHECK(point.color.r == (second ? 0 : 1));
    CHECK(point.uv[0] == Approx(u));
    CHECK(point.normal.z == 1);
    CHECK(point.at.z == 0);
  }
}

TEST_CASE("the normal of a triangle is a unit vector orthogonal to its surface and looks at the ray", "[trace]") {
  Random random;
  for (const auto& empty : {furnished(regular_room(Space::spherical, 3, 2)), furnished(regular_room(Space::euclidean, 4, 2)),
                            furnished(regular_room(Space::hyperbolic, 5, 2))}) {
    auto placed = empty;
    const Space space = placed.polygon.space;
    placed.parts.push_back(soup_of(placed, 40, 0.4, random));
    placed.styles.resize(1);
    const TraceScene scene = prepare(placed);
    int seen = 0;
    for (int i = 0; i < 2000; ++i) {
      const Ray ray = random_ray(placed, random);
      const Hit hit = closest(scene, ray);
      if (hit.kind != HitKind::triangle) continue;
      ++seen;
      const SurfacePoint point = surface_at(scene, ray, hit);
      CHECK(inner(space, point.normal, point.normal) == Approx(1));
      CHECK(inner(space, point.normal, point.incoming) <= 0);
      // Points of the triangle close by, by the definition of a geodesic triangle: their direction is orthogonal to the normal.
      const auto& mesh = placed.parts[0];
      const auto& t = mesh.triangles[hit.triangle];
      for (int j = 0; j < 2; ++j) {
        const double e = 1e-6;
        double b[3] = {hit.b[0], hit.b[1], hit.b[2]};
        b[j] += e;
        b[2] -= e;
        const Ambient sum = b[0] * mesh.floor[t[0]] + b[1] * mesh.floor[t[1]] + b[2] * mesh.floor[t[2]];
        const Point near = geometry::normalised_point(space, sum);
        const double z = b[0] * mesh.z[t[0]] + b[1] * mesh.z[t[1]] + b[2] * mesh.z[t[2]];
        const Direction away{(1 / e) * (near - point.at.floor), (z - point.at.z) / e};
        CHECK(std::fabs(inner(space, point.normal, away)) < 1e-4);
      }
      const Ray back = spawn_ray(scene, point, -point.incoming);
      CHECK(back.t_min == kRayEpsilon);
      CHECK(std::fabs(closest(scene, back).t - hit.t) > -1);
    }
    CHECK(seen > 100);
  }
}
