#include <catch2/catch.hpp>

#include "tests/unit/trace/support.h"

using namespace orbc;
using namespace orbc::trace;
using namespace orbc::trace::testing;

namespace {

double norm_residual(Space space, const Ray& ray) {
  const double k = geometry::curvature(space);
  const auto& p = ray.at;
  const auto& v = ray.along;
  const double pp = p.w * p.w + k * (p.x * p.x + p.y * p.y) - 1;
  const double vv = v.x * v.x + v.y * v.y + k * v.w * v.w - 1;
  const double pv = space == Space::euclidean ? v.w : p.w * v.w + k * (p.x * v.x + p.y * v.y);
  // In H² the squares are as large as p.w²: the residual is measured against them.
  return std::max({std::fabs(pp), std::fabs(vv), std::fabs(pv)}) / (p.w * p.w + v.w * v.w + 1);
}

}  // namespace

TEST_CASE("a ray between mirrors stays on its surface for 80 bounces", "[trace]") {
  Random random;
  for (const auto& placed : {furnished(regular_room(Space::spherical, 3, 2)), furnished(regular_room(Space::euclidean, 4, 2)),
                             furnished(regular_room(Space::hyperbolic, 5, 2)), furnished(regular_room(Space::hyperbolic, 8, 4)),
                             furnished(lune(3)), furnished(hemisphere())}) {
    const TraceScene scene = prepare(placed);
    for (int i = 0; i < 300; ++i) {
      const Ray ray = random_ray(placed, random, 0.01);
      FollowOptions options;
      options.max_bounces = 80;
      const Path path = follow(scene, ray, options);
      CHECK(norm_residual(placed.polygon.space, path.last_ray) < 1e-14);
      if (path.bounces < 80) CHECK((path.hit.kind == HitKind::floor || path.hit.kind == HitKind::ceiling));
      for (const auto& wall : placed.polygon.walls) CHECK(geometry::value_at(wall.line, path.last_ray.at) > -1e-12);
    }
  }
}

TEST_CASE("the word of a path and its end are those of the product of reflections", "[trace]") {
  // Unfolded, the path is one geodesic: the end point is word · end = X(L) of the ray as if there were no walls.
  Random random;
  for (const auto& placed : {furnished(regular_room(Space::spherical, 3, 2)), furnished(regular_room(Space::euclidean, 4, 2)),
                             furnished(regular_room(Space::euclidean, 3, 3)), furnished(regular_room(Space::hyperbolic, 5, 2)),
                             furnished(lune(4)), furnished(hemisphere()), furnished(half_lune(5))}) {
    const Space space = placed.polygon.space;
    const TraceScene scene = prepare(placed);
    for (int i = 0; i < 400; ++i) {
      const Point from = random_point(placed.polygon, random);
      const Ray ray = ray_from(space, {from, random.between(0, 1)}, random_direction(space, from, random, 0.3));
      FollowOptions options;
      options.max_bounces = 12;
      options.max_length = 6;
      options.record_word = true;
      const Path path = follow(scene, ray, options);
      CHECK(static_cast<int>(path.word.size()) == path.bounces);
      CHECK(path.throughput.r == Approx(std::pow(0.9, path.bounces)));
      auto cover_from_room = geometry::identity(space);
      for (const auto wall : path.word) cover_from_room = cover_from_room * geometry::reflection(space, placed.polygon.walls[wall].line);
      const Point end = position_at(space, path.last_ray, path.hit.t).floor;
      const Point unfolded = position_at(space, ray, path.length).floor;
      const double tolerance = space == Space::hyperbolic ? 1e-14 * std::exp(2 * path.length) + 1e-12 : 1e-12;
      CHECK(geometry::distance(space, cover_from_room * end, unfolded) < tolerance);
    }
  }
}

TEST_CASE("a mirror after max_bounces cuts the path off, a plain wall ends it", "[trace]") {
  auto placed = furnished(regular_room(Space::euclidean, 4, 2, std::numbers::sqrt2));
  const TraceScene scene = prepare(placed);
  Ray ray;
  ray.along = {0, std::sqrt(0.5), std::sqrt(0.5)};
  ray.z = 0.5;
  FollowOptions options;
  options.max_bounces = 3;
  Path path = follow(scene, ray, options);
  CHECK(path.cut_off);
  CHECK(path.bounces == 3);
  CHECK(path.length == Approx(7));
  CHECK(path.throughput.g == Approx(0.729));
  options.max_bounces = 100;
  options.min_weight = 0.7;
  path = follow(scene, ray, options);
  CHECK(path.cut_off);
  CHECK(path.bounces == 3);
  placed.mirrors[0].height[0] = 0.6;
  const TraceScene plain = prepare(placed);
  path = follow(plain, ray, options);
  CHECK_FALSE(path.cut_off);
  CHECK(path.hit.kind == HitKind::wall);
}

TEST_CASE("a ray into a corner comes back as the limit of its neighbours", "[trace]") {
  // In a corner π/k with k even the ray comes back on itself, after k reflections.
  for (const int k : {2, 4}) {
    const auto placed = furnished(k == 2 ? regular_room(Space::euclidean, 4, 2) : regular_room(Space::hyperbolic, 8, 4));
    const Space space = placed.polygon.space;
    const TraceScene scene = prepare(placed);
    const double radius = placed.polygon.circumradius;
    Random random;
    for (int corner = 0; corner < static_cast<int>(placed.polygon.corners.size()); ++corner) {
      for (int i = 0; i < 20; ++i) {
        const Point from = random_point(placed.polygon, random);
        const Point& to = placed.polygon.corners[corner].at;
        Ray ray;
        ray.at = from;
        ray.along = geometry::direction_to(space, from, to);
        ray.z = 0.5;
        FollowOptions options;
        options.max_bounces = 1000;
        const double there = geometry::distance(space, from, to);
        options.max_length = 2 * there;
        const Path path = follow(scene, ray, options);
        CHECK(path.bounces == k);
        CHECK(geometry::distance(space, position_at(space, path.last_ray, path.hit.t).floor, from) < 1e-9 * std::exp(2 * radius));
      }
    }
  }
}

TEST_CASE("a ray that starts on a wall, rounded to either side of it, and points out of the room meets that wall at once", "[trace]") {
  for (const auto& room :
       {regular_room(Space::spherical, 3, 2), regular_room(Space::euclidean, 5, 2), regular_room(Space::hyperbolic, 5, 2)}) {
    const Prism prism{room.space, 1, room.walls};
    Random random{4};
    int behind = 0;
    for (int i = 0; i < 400; ++i) {
      const int wall = static_cast<int>(random.bits() % room.walls.size());
      const room::Wall& w = room.walls[static_cast<std::size_t>(wall)];
      const double s = w.length * random.between(0.1, 0.9), turn = random.between(0.05, kPi - 0.05);
      const Point at = geometry::point_along(room.space, w.start, w.along, s);
      const Direction in = normal_of_wall(room.space, w);
      const auto along = geometry::direction_along(room.space, w.start, w.along, s);
      const Ray ray = ray_from(room.space, {at, 0.5}, {std::cos(turn) * Ambient(along) - std::sin(turn) * in.floor, 0.1});
      behind += geometry::value_at(w.line, ray.at) < 0;
      const Exit exit = exit_of(prism, ray);
      CHECK(exit.surface == wall);
      CHECK(exit.t < 1e-12);
      const Ray back = reflected_in_wall(prism, ray, exit.t, wall);
      CHECK(exit_of(prism, back).t > 1e-3);
    }
    CHECK(behind > 20);
  }
}

TEST_CASE("the cotangent of the arc to a wall reflects a ray where its length does, and on the same mirror", "[trace]") {
  for (const auto& placed : {furnished(regular_room(Space::spherical, 3, 2)), furnished(regular_room(Space::euclidean, 4, 2)),
                             furnished(regular_room(Space::hyperbolic, 5, 2)), furnished(hemisphere()), furnished(lune(2))}) {
    const TraceScene scene = prepare(placed);
    const Space space = scene.prism.space;
    Random random{5};
    int walls = 0;
    for (int i = 0; i < 300; ++i) {
      const double turn = random.between(0, 2 * kPi);
      const Ray ray = ray_from(space, {{}, random.between(0.2, 0.8) * scene.prism.height},
                               {{0, std::cos(turn), std::sin(turn)}, random.between(-0.3, 0.3)});
      const Exit exit = exit_of(scene.prism, ray);
      if (exit.surface < 0) continue;
      ++walls;
      const Ray by_length = reflected_in_wall(scene.prism, ray, exit.t, exit.surface), by_cot = reflected_in_wall(scene.prism, ray, exit);
      const Ambient apart = by_length.at - by_cot.at, turned = by_length.along - by_cot.along;
      CHECK(std::fabs(apart.w) + std::fabs(apart.x) + std::fabs(apart.y) < 1e-13);
      CHECK(std::fabs(turned.w) + std::fabs(turned.x) + std::fabs(turned.y) < 1e-13);
      CHECK(by_length.z == by_cot.z);
      CHECK(mirror_at(scene, ray, exit.t, exit.surface) == mirror_at(scene, {by_cot.at, by_cot.z}, exit.surface));
      // A ray that stays inside up to a length need not tell where it leaves, but never claims to stay when it does not.
      CHECK(exit_of(scene.prism, ray, 0.999 * exit.t).t >= exit.t);
      CHECK(exit_of(scene.prism, ray, 1.001 * exit.t).t == exit.t);
    }
    CHECK(walls > 100);
  }
}

TEST_CASE("vertical rays, rays in a wall and rays in an edge of the room find their way", "[trace]") {
  for (const auto& placed : {furnished(regular_room(Space::spherical, 3, 2)), furnished(regular_room(Space::euclidean, 4, 2)),
                             furnished(regular_room(Space::hyperbolic, 5, 2)), furnished(hemisphere()), furnished(lune(2))}) {
    const Space space = placed.polygon.space;
    const TraceScene scene = prepare(placed);
    const auto up = follow(scene, ray_from(space, {{}, 0.25}, {{0, 0, 0}, 3}));
    CHECK(up.hit.kind == HitKind::ceiling);
    CHECK(up.length == 0.75);
    const auto down = follow(scene, ray_from(space, {{}, 0.25}, {{0, 0, 0}, -3}));
    CHECK(down.hit.kind == HitKind::floor);
    CHECK(down.length == 0.25);
    for (const auto& wall : placed.polygon.walls) {
      const Point from = geometry::point_along(space, wall.start, wall.along, 0.3 * wall.length);
      const auto along = geometry::direction_along(space, wall.start, wall.along, 0.3 * wall.length);
      const Path path = follow(scene, ray_from(space, {from, 0.5}, {0.99 * along, 0.1}), {.max_bounces = 50});
      CHECK((path.hit.kind == HitKind::ceiling));
      CHECK(path.length == Approx(0.5 * std::hypot(0.99, 0.1) / 0.1));
    }
    for (const auto& corner : placed.polygon.corners) {
      const Path edge = follow(scene, ray_from(space, {corner.at, 0.5}, {{0, 0, 0}, 1}));
      CHECK(edge.hit.kind == HitKind::ceiling);
      CHECK(edge.bounces == 0);
    }
  }
}

TEST_CASE("a ceiling mirror and a floor mirror stack the storeys", "[trace]") {
  auto placed = furnished(regular_room(Space::hyperbolic, 5, 2));
  placed.mirrors.push_back({-1, {0, 0}, {0, 0}, {0.5, 0.5, 0.5}});
  placed.mirrors.push_back({-2, {0, 0}, {0, 0}, {0.25, 0.25, 0.25}});
  const TraceScene scene = prepare(placed);
  FollowOptions options;
  options.record_word = true;
  options.max_length = 4.25;
  const Path path = follow(scene, ray_from(Space::hyperbolic, {{}, 0.5}, {{0, 0, 0}, 1}), options);
  CHECK(path.word == std::vector<std::int16_t>{-2, -1, -2, -1});
  CHECK(path.throughput.r == 1.0 / 64);
  CHECK(position_at(Space::hyperbolic, path.last_ray, path.hit.t).z == Approx(0.75));
}

TEST_CASE("a path on S² goes on past the antipode", "[trace]") {
  // The hemisphere: a horizontal ray meets its mirror every half turn; after a full turn of the unfolded sphere it is back.
  const auto placed = furnished(hemisphere());
  const TraceScene scene = prepare(placed);
  Random random;
  for (int i = 0; i < 50; ++i) {
    const Point from = random_point(placed.polygon, random);
    Ray ray = ray_from(Space::spherical, {from, 0.5}, random_direction(Space::spherical, from, random, 0));
    FollowOptions options;
    options.max_bounces = 1000;
    options.max_length = 2 * kPi * 7;
    const Path path = follow(scene, ray, options);
    CHECK(path.bounces == 14);
    CHECK(geometry::distance(Space::spherical, position_at(Space::spherical, path.last_ray, path.hit.t).floor, from) < 1e-12);
  }
}
