#include <catch2/catch.hpp>

#include <cstring>

#include "tests/support/instruction_sets.h"
#include "tests/support/threads.h"
#include "tests/unit/trace/support.h"

using namespace orbc;
using namespace orbc::trace;
using namespace orbc::trace::testing;

namespace {

struct Tally {
  int hits = 0, wrong = 0;
  BvhCounts counts;
};

/// The same decision, the same path length up to rounding (two surfaces at the same place may both be right).
bool same(const BvhHit& fast, const BvhHit& slow) {
  if ((fast.triangle != kNoTriangle) != (slow.triangle != kNoTriangle)) return false;
  return slow.triangle == kNoTriangle || std::fabs(fast.t - slow.t) <= 1e-12 * (1 + slow.t);
}

/// Every ray through the tree and through all triangles: the same triangle (or the same t, for ties on shared edges).
Tally compare(const place::Interior& placed, const Bvh& bvh, int rays, Random& random, double steep = 1) {
  Tally tally;
  const Space space = placed.polygon.space;
  for (int i = 0; i < rays; ++i) {
    const Ray ray = random_ray(placed, random, steep);
    const double end = space == Space::spherical && ray.c > 0 ? kPi / ray.c : kInfinity;
    const BvhHit fast = bvh.closest_counted(ray, end, tally.counts);
    const BvhHit slow = try_all(space, bvh.triangles(), ray, end);
    tally.hits += slow.triangle != kNoTriangle;
    if (!same(fast, slow)) {
      ++tally.wrong;
      UNSCOPED_INFO("ray " << i << ": fast " << fast.triangle << " at " << fast.t << ", slow " << slow.triangle << " at " << slow.t
                           << ", m " << ray.m);
    }
    CHECK(bvh.occluded(ray, end) == (slow.triangle != kNoTriangle));
  }
  return tally;
}

SceneTriangles soup_from(const place::PlacedMesh& mesh) {
  SceneTriangles soup;
  for (std::size_t i = 0; i < mesh.floor.size(); ++i)
    soup.vertices.push_back({mesh.floor[i].w, mesh.floor[i].x, mesh.floor[i].y, mesh.z[i]});
  for (const auto& t : mesh.triangles) soup.corners.push_back({t[0], t[1], t[2]});
  soup.parts.push_back({0, 0});
  return soup;
}

}  // namespace

TEST_CASE("the tree finds exactly what trying all triangles finds", "[trace]") {
  Random random;
  for (const auto& placed : {furnished(regular_room(Space::spherical, 3, 2)), furnished(regular_room(Space::euclidean, 4, 2)),
                             furnished(regular_room(Space::hyperbolic, 5, 2)), furnished(regular_room(Space::hyperbolic, 8, 4)),
                             furnished(lune(2)), furnished(lune(5)), furnished(half_lune(6)), furnished(hemisphere())}) {
    const Space space = placed.polygon.space;
    for (const auto& [count, size] : {std::pair{30, 1.0}, {400, 0.15}, {3000, 0.03}}) {
      const Bvh bvh(space, soup_from(soup_of(placed, count, size, random)), serial_executor());
      for (const double steep : {1.0, 0.1, 1e-4, 1e-8, 0.0}) {
        const Tally tally = compare(placed, bvh, count > 1000 ? 200 : 600, random, steep);
        INFO("curvature " << geometry::curvature(space) << ", " << count << " triangles of " << size << ", slopes to " << steep << ", "
                          << tally.hits << " hits, charts " << bvh.charts().size() << ", large " << bvh.uncharted().size());
        CHECK(tally.wrong == 0);
      }
    }
  }
}

TEST_CASE("the tree finds what vertical and nearly vertical rays meet", "[trace]") {
  Random random;
  for (const auto& placed : {furnished(regular_room(Space::spherical, 3, 2)), furnished(regular_room(Space::euclidean, 4, 2)),
                             furnished(regular_room(Space::hyperbolic, 5, 2))}) {
    const Space space = placed.polygon.space;
    const Bvh bvh(space, soup_from(soup_of(placed, 400, 0.2, random)), serial_executor());
    int hits = 0, wrong = 0;
    for (int i = 0; i < 2000; ++i) {
      const Point p = random_point(placed.polygon, random);
      Direction d = random_direction(space, p, random, 0);
      d.floor = (i % 4 == 0 ? 0 : std::pow(10.0, -random.between(1, 12))) * d.floor;
      d.z = i % 2 ? 1 : -1;
      const Ray ray = ray_from(space, {p, random.between(0, 1)}, d);
      const double end = space == Space::spherical && ray.c > 0 ? kPi / ray.c : kInfinity;
      const BvhHit fast = bvh.closest(ray, end), slow = try_all(space, bvh.triangles(), ray, end);
      hits += slow.triangle != kNoTriangle;
      wrong += !same(fast, slow);
    }
    CHECK(hits > 500);
    CHECK(wrong == 0);
  }
}

TEST_CASE("many rays at once meet what each alone meets", "[trace]") {
  Random random;
  for (const auto& room : {regular_room(Space::spherical, 3, 2), regular_room(Space::euclidean, 4, 2),
                           regular_room(Space::hyperbolic, 5, 2), lune(2), hemisphere()}) {
    auto placed = furnished(room);
    placed.parts.push_back(soup_of(placed, 60, 0.8, random));
    placed.parts.push_back(soup_of(placed, 600, 0.1, random));
    placed.styles.resize(1);
    const TraceScene scene = prepare(placed);
    for (const std::size_t count : {1, 7, 8, 33, 2000}) {
      std::vector<Ray> rays;
      for (std::size_t i = 0; i < count; ++i) {
        rays.push_back(random_ray(placed, random, i % 3 == 0 ? 1 : i % 3 == 1 ? 0.1 : 0));
        if (i % 5 == 0) rays.back().t_min = 0.2 * random.unit();
        if (i % 7 == 0) rays.back().c = 0, rays.back().m = 1;
      }
      const std::vector<Hit> hits = closest(scene, rays);
      REQUIRE(hits.size() == count);
      int wrong = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const Hit one = closest(scene, rays[i]);
        const bool triangle = one.kind == HitKind::triangle;
        wrong += hits[i].kind != one.kind || std::fabs(hits[i].t - one.t) > 1e-12 * (1 + one.t) || hits[i].wall != one.wall;
        if (triangle && hits[i].triangle == one.triangle)
          for (int j = 0; j < 3; ++j) wrong += std::fabs(hits[i].b[j] - one.b[j]) > 1e-9;
        const BvhHit slow = try_all(room.space, scene.objects->triangles(), rays[i],
                                    room.space == Space::spherical && rays[i].c > 0 ? kPi / rays[i].c : kInfinity);
        wrong += triangle != (slow.triangle != kNoTriangle) || (triangle && std::fabs(slow.t - one.t) > 1e-12 * (1 + slow.t));
      }
      CHECK(wrong == 0);
      const std::vector<Path> paths = follow(scene, rays, {.max_bounces = 5, .record_word = true});
      for (std::size_t i = 0; i < count; ++i) {
        const Path path = follow(scene, rays[i], {.max_bounces = 5, .record_word = true});
        wrong += paths[i].word != path.word || paths[i].hit.kind != path.hit.kind || std::fabs(paths[i].length - path.length) > 1e-9;
      }
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("the tree is the same for any number of threads and small", "[trace]") {
  const auto mesh = torus_knot(Space::hyperbolic, {}, 0.25, 0.06, 0.5, 500, 20);
  const Executor backwards = [](std::size_t count, const std::function<void(std::size_t)>& task) {
    for (std::size_t i = count; i-- > 0;) task(i);
  };
  const Bvh a(Space::hyperbolic, soup_from(mesh), serial_executor()), b(Space::hyperbolic, soup_from(mesh), backwards);
  REQUIRE(a.charts().size() == 1);
  const ChartTree &x = a.charts()[0], &y = b.charts()[0];
  REQUIRE(x.nodes.size() == y.nodes.size());
  REQUIRE(x.blocks.size() == y.blocks.size());
  for (std::size_t i = 0; i < x.nodes.size(); ++i)
    for (int j = 0; j < 8; ++j) CHECK(x.nodes[i].child[j] == y.nodes[i].child[j]);
  for (std::size_t i = 0; i < x.blocks.size(); ++i)
    for (int j = 0; j < 8; ++j) CHECK(x.blocks[i].triangle[j] == y.blocks[i].triangle[j]);
  CHECK(static_cast<double>(a.bytes()) / static_cast<double>(mesh.triangles.size()) < 100);
}

TEST_CASE("few nodes are visited and few candidates fail", "[trace]") {
  Random random;
  for (const auto& placed : {furnished(regular_room(Space::spherical, 3, 2)), furnished(regular_room(Space::euclidean, 4, 2)),
                             furnished(regular_room(Space::hyperbolic, 5, 2))}) {
    const Space space = placed.polygon.space;
    const Bvh bvh(space, soup_from(torus_knot(space, {}, 0.25, 0.06, 0.5, 312, 20)), serial_executor());
    Tally tally = compare(placed, bvh, 500, random);
    CHECK(tally.wrong == 0);
    INFO("curvature " << geometry::curvature(space) << ": of 500 rays " << tally.hits << " hits, nodes " << tally.counts.nodes
                      << ", blocks " << tally.counts.blocks << ", candidates " << tally.counts.candidates << ", bytes/triangle "
                      << double(bvh.bytes()) / double(bvh.triangles().corners.size()));
    CHECK(tally.counts.candidates < 1.3 * tally.hits + 20);
  }
}

TEST_CASE("a scene without objects and one with a single triangle work", "[trace]") {
  auto placed = furnished(regular_room(Space::euclidean, 4, 2));
  const TraceScene empty = prepare(placed);
  CHECK(closest(empty, ray_from(Space::euclidean, {{}, 0.5}, {{0, 1, 0}, 0})).kind == HitKind::wall);
  CHECK_FALSE(occluded(empty, ray_from(Space::euclidean, {{}, 0.5}, {{0, 1, 0}, 0}), 10));
  place::PlacedMesh mesh;
  mesh.floor = {{1, 0.3, -0.2}, {1, 0.3, 0.2}, {1, 0.3, 0}};
  mesh.z = {0.4, 0.4, 0.8};
  mesh.triangles = {{0, 1, 2}};
  mesh.style = {0};
  placed.parts = {mesh};
  placed.styles.resize(1);
  const TraceScene one = prepare(placed);
  const Hit hit = closest(one, ray_from(Space::euclidean, {{}, 0.5}, {{0, 1, 0}, 0}));
  CHECK(hit.kind == HitKind::triangle);
  CHECK(hit.t == Approx(0.3));
  CHECK(occluded(one, ray_from(Space::euclidean, {{}, 0.5}, {{0, 1, 0}, 0}), 0.31));
  CHECK_FALSE(occluded(one, ray_from(Space::euclidean, {{}, 0.5}, {{0, 1, 0}, 0}), 0.29));
}

TEST_CASE("a ray meets the same thing alone and among others, bit by bit", "[trace]") {
  Random random{31};
  for (const auto& room :
       {regular_room(Space::spherical, 3, 2), regular_room(Space::euclidean, 4, 2), regular_room(Space::hyperbolic, 5, 2), lune(3)}) {
    auto placed = furnished(room);
    placed.parts.push_back(torus_knot(room.space, room.corners.size() > 2 ? Point() : at_polar(room.space, 0.4, 1), 0.2, 0.06, 0.5, 40, 8));
    placed.parts.push_back(soup_of(placed, 40, 0.4, random));  // near to each other: ends in double
    placed.styles.resize(1);
    const TraceScene scene = prepare(placed);
    std::vector<Ray> rays;
    for (int i = 0; i < 2000; ++i) rays.push_back(random_ray(placed, random));
    const std::vector<Hit> together = closest(scene, rays);
    const std::vector<Path> paths = follow(scene, rays);
    int different = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Hit alone = closest(scene, rays[i]);
      const Path path = follow(scene, rays[i]);
      different += alone.kind != together[i].kind || alone.t != together[i].t || alone.triangle != together[i].triangle ||
                   alone.b[1] != together[i].b[1];
      different += path.length != paths[i].length || path.bounces != paths[i].bounces || path.hit.t != paths[i].hit.t ||
                   path.last_ray.at.x != paths[i].last_ray.at.x;
    }
    CHECK(different == 0);
  }
}

TEST_CASE("rays of a fan meet the same things alone and together, bit by bit", "[trace]") {
  Random random{5};
  for (const auto& room : {regular_room(Space::spherical, 3, 2), regular_room(Space::euclidean, 4, 2),
                           regular_room(Space::hyperbolic, 5, 2), regular_room(Space::hyperbolic, 8, 4), lune(2), lune(5), hemisphere()}) {
    auto placed = furnished(room);
    placed.parts.push_back(torus_knot(room.space, room.corners.size() > 2 ? Point() : at_polar(room.space, 0.4, 1), 0.2, 0.06, 0.5, 60, 8));
    placed.parts.push_back(soup_of(placed, 2000, 0.03, random));
    placed.parts.push_back(soup_of(placed, 20, 0.4, random));
    placed.styles.resize(1);
    const TraceScene scene = prepare(placed);
    int different = 0, hits = 0;
    for (int fan = 0; fan < 60; ++fan) {
      const double spread = std::pow(10.0, -random.between(0.5, 7));
      const Point from = random_point(room, random);
      const Point apart = fan % 3 ? from : random_point(room, random);  // rays from one point, or from along a line
      Direction towards = random_direction(room.space, from, random, fan % 4 ? 0.3 : 1);
      std::vector<Ray> rays;
      for (int i = 0; i < 64; ++i) {
        const double along = spread * random.unit();
        const Point at = fan % 3 ? from : geometry::normalised_point(room.space, (1 - along) * from + along * apart);
        Direction d = towards;
        d.floor = d.floor + random.between(-spread, spread) * geometry::Ambient{0, -towards.floor.y, towards.floor.x};
        d.floor = geometry::normalised_tangent(room.space, at, d.floor);
        d.z += random.between(-spread, spread);
        rays.push_back(ray_from(room.space, {at, 0.5}, d));
      }
      const std::vector<Hit> together = closest(scene, rays);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const Hit alone = closest(scene, rays[i]);
        hits += alone.kind == HitKind::triangle;
        different += alone.kind != together[i].kind || alone.t != together[i].t || alone.triangle != together[i].triangle ||
                     alone.b[1] != together[i].b[1];
      }
    }
    INFO("curvature " << geometry::curvature(room.space) << ", " << room.corners.size() << " corners, " << hits << " hits");
    CHECK(hits > 500);
    CHECK(different == 0);
  }
}

TEST_CASE("threads build the tree that one alone does, and walk it at once", "[trace][threads]") {
  auto placed = furnished(regular_room(Space::hyperbolic, 5, 2));
  // Enough triangles for tasks and for parallel binning
  placed.parts.push_back(torus_knot(Space::hyperbolic, {}, 0.2, 0.06, 0.5, 1000, 20));
  placed.parts.push_back(torus_knot(Space::hyperbolic, at_polar(Space::hyperbolic, 0.2, 1), 0.2, 0.06, 0.5, 1000, 20));
  placed.styles.resize(1);
  const TraceScene alone = prepare(placed), together = prepare(placed, orbc::testing::threads(4));
  const ChartTree &a = alone.objects->charts()[0], &b = together.objects->charts()[0];
  REQUIRE((a.nodes.size() == b.nodes.size() && a.blocks.size() == b.blocks.size()));
  int different = 0;
  for (std::size_t i = 0; i < a.nodes.size(); ++i) different += !std::equal(a.nodes[i].child, a.nodes[i].child + 8, b.nodes[i].child);
  for (std::size_t i = 0; i < a.blocks.size(); ++i)
    different += !std::equal(a.blocks[i].triangle, a.blocks[i].triangle + 8, b.blocks[i].triangle);
  CHECK(different == 0);
  Random random{8};
  std::vector<Ray> rays;
  for (int i = 0; i < 4000; ++i) rays.push_back(random_ray(placed, random));
  const std::vector<Path> want = follow(alone, rays);
  std::vector<double> lengths(rays.size());
  orbc::testing::threads(4)(40, [&](std::size_t task) {
    const auto paths = follow(together, std::span(rays).subspan(100 * task, 100));
    for (std::size_t i = 0; i < 100; ++i) lengths[100 * task + i] = paths[i].length;
  });
  for (std::size_t i = 0; i < rays.size(); ++i) different += lengths[i] != want[i].length;
  CHECK(different == 0);
}

TEST_CASE("rays meet the same things with every instruction set, bit by bit", "[trace]") {
  Random random{77};
  for (const auto& room : {regular_room(Space::spherical, 3, 2), regular_room(Space::euclidean, 4, 2),
                           regular_room(Space::hyperbolic, 5, 2), regular_room(Space::hyperbolic, 8, 4), lune(2), lune(5), hemisphere()}) {
    auto placed = furnished(room);
    placed.parts.push_back(torus_knot(room.space, room.corners.size() > 2 ? Point() : at_polar(room.space, 0.4, 1), 0.2, 0.06, 0.5, 60, 8));
    placed.parts.push_back(soup_of(placed, 2000, 0.03, random));
    placed.parts.push_back(soup_of(placed, 40, 0.4, random));  // near to each other: ends in double
    placed.styles.resize(1);
    const TraceScene scene = prepare(placed);
    std::vector<Ray> rays;
    for (int i = 0; i < 6000; ++i) {
      rays.push_back(random_ray(placed, random, i % 3 == 0 ? 1 : i % 3 == 1 ? 0.1 : 0));
      if (i % 7 == 0) rays.back().t_min = 0.2 * random.unit();
    }
    const auto made = orbc::testing::with_each_instruction_set([&] {
      std::vector<double> numbers;
      const auto tell = [&](const Hit& hit) {
        for (const double value : {double(static_cast<int>(hit.kind)), double(hit.triangle), hit.t, hit.b[0], hit.b[1], hit.b[2]})
          numbers.push_back(value);
      };
      for (const Hit& hit : closest(scene, rays)) tell(hit);
      for (const Ray& ray : rays) {
        tell(closest(scene, ray));
        numbers.push_back(occluded(scene, ray, 0.7));
      }
      return numbers;
    });
    for (std::size_t i = 1; i < made.size(); ++i) {
      INFO("curvature " << geometry::curvature(room.space) << ", " << room.corners.size() << " corners, "
                        << orbc::testing::name_of(orbc::testing::instruction_sets()[i]));
      CHECK(std::memcmp(made[i].data(), made[0].data(), made[0].size() * sizeof(double)) == 0);
    }
  }
}
