// A million rays: slow, part of CI. (The fast set runs the same laws over fewer.)
#include <catch2/catch.hpp>

#include "tests/property/trace/laws.h"

using namespace orbc;
using namespace orbc::trace;
using namespace orbc::trace::testing;

namespace {

struct Tally {
  int rays = 0, hits = 0, missed = 0, false_hits = 0, elsewhere = 0;
  double residual = 0;
};

void compare(const place::Interior& placed, int rays, double steep, Random& random, Tally& tally) {
  const Space space = placed.polygon.space;
  const TraceScene scene = prepare(placed);
  const SceneTriangles& soup = scene.objects->triangles();
  std::vector<Ray> all;
  for (int i = 0; i < rays; ++i) all.push_back(random_ray(placed, random, steep));
  const std::vector<Hit> together = closest(scene, all);
  for (int i = 0; i < rays; ++i) {
    const Ray& ray = all[static_cast<std::size_t>(i)];
    const Hit& with_others = together[static_cast<std::size_t>(i)];
    const double end = space == Space::spherical && ray.c > 0 ? kPi / ray.c : kInfinity;
    const BvhHit slow = try_all(space, soup, ray, end);
    const Hit fast = closest_triangle(scene, ray);
    ++tally.rays;
    const bool met = fast.kind == HitKind::triangle, meets = slow.triangle != kNoTriangle;
    const Hit alone = closest(scene, ray);  // walls included
    tally.elsewhere += with_others.kind != alone.kind || std::fabs(with_others.t - alone.t) > 1e-11 * (1 + alone.t);
    tally.hits += meets;
    tally.missed += meets && !met;
    tally.false_hits += met && !meets;
    if (!met) continue;
    tally.elsewhere += meets && std::fabs(fast.t - slow.t) > 1e-11 * (1 + slow.t);
    const auto& mesh = placed.parts[fast.part];
    const auto& t = mesh.triangles[fast.triangle];
    const Ambient sum = fast.b[0] * mesh.floor[t[0]] + fast.b[1] * mesh.floor[t[1]] + fast.b[2] * mesh.floor[t[2]];
    const auto at = position_at(space, ray, fast.t);
    const double z = fast.b[0] * mesh.z[t[0]] + fast.b[1] * mesh.z[t[1]] + fast.b[2] * mesh.z[t[2]];
    tally.residual =
        std::max(tally.residual, std::hypot(geometry::distance(space, geometry::normalised_point(space, sum), at.floor), z - at.z) /
                                     std::max(fast.t, 1e-3));
  }
}

}  // namespace

TEST_CASE("a million rays in every space meet what trying all triangles in double finds", "[trace][slow][long]") {
  Random random{7};
  const std::vector<std::vector<room::Room>> spaces{{regular_room(Space::spherical, 3, 2), lune(2), lune(5), half_lune(6), hemisphere()},
                                                    {regular_room(Space::euclidean, 4, 2)},
                                                    {regular_room(Space::hyperbolic, 5, 2), regular_room(Space::hyperbolic, 8, 4)}};
  for (const auto& rooms : spaces) {
    Tally tally;
    for (const auto& room : rooms)
      for (int scene = 0; scene < 5; ++scene) {
        auto placed = furnished(room);
        if (scene < 2) placed.parts.push_back(soup_of(placed, scene == 0 ? 40 : 300, scene == 0 ? 1.0 : 0.12, random));
        else
          placed.parts.push_back(torus_knot(room.space, room.corners.size() > 2 ? Point() : at_polar(room.space, 0.4, 1), 0.2, 0.06, 0.5,
                                            scene == 2 ? 14 : 30, scene == 2 ? 5 : 8));
        placed.styles.resize(1);
        compare(placed, 200'000 / static_cast<int>(rooms.size()), scene == 4 ? 0.02 : 1, random, tally);
      }
    INFO(tally.rays << " rays, " << tally.hits << " hits, " << tally.missed << " missed, " << tally.false_hits << " false, "
                    << tally.elsewhere << " elsewhere, residual " << tally.residual);
    CHECK(tally.rays == 1'000'000);
    CHECK(tally.missed == 0);
    CHECK(tally.false_hits == 0);
    CHECK(tally.elsewhere == 0);
    CHECK(tally.residual < 1e-9);
  }
}

TEST_CASE("a million rays at vertices and edges of closed surfaces all stop", "[trace][slow][long]") {
  for (const auto& space : {Space::spherical, Space::euclidean, Space::hyperbolic}) CHECK(leaks(space, 120'000, 11) == 0);
}

TEST_CASE("a hundred thousand rays that leave surfaces go on rightly", "[trace][slow]") {
  for (const auto& space : {Space::spherical, Space::euclidean, Space::hyperbolic}) CHECK(wrong_departures(space, 35'000, 12) == 0);
}
