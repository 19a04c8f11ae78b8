#pragma once
// Rooms and meshes for the tests of the tracer, by closed forms of their own: nothing here comes from room/ or place/.
#include <cmath>
#include <cstdint>
#include <numbers>

#include "compiler/geometry/chart.h"
#include "compiler/geometry/isometry.h"
#include "compiler/trace/bvh/bvh.h"
#include "compiler/trace/follow.h"

namespace orbc::trace::testing {

using geometry::Ambient;
using geometry::Point;
using geometry::Space;
using geometry::Tangent;

inline constexpr double kPi = std::numbers::pi;

/// A generator of its own (splitmix64), so that every platform draws the same numbers.
struct Random {
  std::uint64_t state = 1;
  std::uint64_t bits() {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double between(double lo, double hi) { return lo + (hi - lo) * unit(); }
};

inline Point at_polar(Space space, double r, double angle) {
  return {geometry::cos_k(space, r), geometry::sin_k(space, r) * std::cos(angle), geometry::sin_k(space, r) * std::sin(angle)};
}

inline void close_room(room::Room& room) {
  const int n = static_cast<int>(room.corners.size());
  for (int i = 0; i < n; ++i) {
    const Point& p = room.corners[i].at;
    const Point& q = room.corners[(i + 1) % n].at;
    room.walls.push_back({geometry::line_through(room.space, p, q), p, geometry::direction_to(room.space, p, q),
                          geometry::distance(room.space, p, q), true});
    room.outline.push_back(p);
    room.outline_wall.push_back(i);
  }
}

/// The regular N-gon with corners π/k: cosκ R = cot(π/N)·cot(π/2k); E²: R given.
inline room::Room regular_room(Space space, int n, double k, double euclidean_radius = 1) {
  room::Room room;
  room.space = space;
  const double cosine = 1 / (std::tan(kPi / n) * std::tan(kPi / (2 * k)));
  const double radius = space == Space::spherical ? std::acos(cosine) : space == Space::hyperbolic ? std::acosh(cosine) : euclidean_radius;
  for (int i = 0; i < n; ++i) room.corners.push_back({at_polar(space, radius, 2 * kPi * i / n), kPi / k});
  close_room(room);
  room.circumradius = radius;
  return room;
}

/// The lune *kk: corners a quarter turn to both sides of the centre.
inline room::Room lune(int k) {
  room::Room room;
  room.space = Space::spherical;
  room.corners = {{{0, 1, 0}, kPi / k}, {{0, -1, 0}, kPi / k}};
  const double half = kPi / (2 * k);
  room.walls = {{{std::sin(half), 0, -std::cos(half)}, {0, 1, 0}, {std::cos(half), 0, std::sin(half)}, kPi, true},
                {{std::sin(half), 0, std::cos(half)}, {0, -1, 0}, {std::cos(half), 0, -std::sin(half)}, kPi, true}};
  room.circumradius = kPi / 2;
  return room;
}

inline room::Room hemisphere() {
  room::Room room;
  room.space = Space::spherical;
  room.walls = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 2 * kPi, true}};
  room.circumradius = kPi / 2;
  return room;
}

/// The triangle *22k: a corner π/k at the pole, two right corners on the equator; centred roughly, as room/ would centre it.
inline room::Room half_lune(int k) {
  room::Room room;
  room.space = Space::spherical;
  const double half = kPi / (2 * k);
  // In the frame with the pole at (1,0,0): the centre at distance `middle` towards the middle of the equator's piece.
  const double middle = kPi / 2 - std::atan(std::sin(half));
  const auto back = geometry::translation_by(Space::spherical, middle, 0);
  const auto turn = geometry::rotation(Space::spherical, kPi);
  for (const Point& p : {Point(1, 0, 0), Point(0, std::cos(half), -std::sin(half)), Point(0, std::cos(half), std::sin(half))})
    room.corners.push_back({turn * (geometry::inverse(back) * p), 0});
  room.corners[0].angle = kPi / k;
  close_room(room);
  return room;
}

inline place::Interior furnished(room::Room room, double height = 1, double reflectance = 0.9) {
  place::Interior placed;
  placed.height = height;
  for (int i = 0; i < static_cast<int>(room.walls.size()); ++i)
    placed.mirrors.push_back({i, {0, room.walls[i].length}, {0, height}, {reflectance, reflectance, reflectance}});
  placed.polygon = std::move(room);
  return placed;
}

/// A torus knot tube (2, 3) around the room's axis, placed by distances from `centre` (exponential map), 2·steps·around triangles.
inline place::PlacedMesh torus_knot(Space space, const Point& centre, double radius, double tube, double z, int steps, int around) {
  place::PlacedMesh mesh;
  const auto move = geometry::translation_to(space, centre);
  const auto knot = [&](double t) {
    const double r = radius * (1 + 0.35 * std::cos(3 * t));
    return geometry::Vector3{r * std::cos(2 * t), r * std::sin(2 * t), z + 0.35 * radius * std::sin(3 * t)};
  };
  for (int i = 0; i < steps; ++i) {
    const double t = 2 * kPi * i / steps;
    const auto p = knot(t);
    const auto along = normalised(knot(t + 1e-4) - knot(t - 1e-4));
    const auto u = normalised(cross(along, geometry::Vector3{0, 0, 1}));
    const auto w = cross(u, along);
    for (int j = 0; j < around; ++j) {
      const double a = 2 * kPi * j / around;
      const auto q = p + tube * std::cos(a) * u + tube * std::sin(a) * w;
      mesh.floor.push_back(move * geometry::point_from_log(space, {q.x, q.y}));
      mesh.z.push_back(q.z);
    }
  }
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < around; ++j) {
      const auto id = [&](int a, int b) { return static_cast<std::uint32_t>((a % steps) * around + b % around); };
      mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      mesh.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  mesh.style.assign(mesh.triangles.size(), 0);
  return mesh;
}

/// A point of the room: rejection in polar coordinates around the centre.
inline Point random_point(const room::Room& room, Random& random, double margin = 0) {
  for (;;) {
    const Point p = at_polar(room.space, room.circumradius * std::sqrt(random.unit()), random.between(0, 2 * kPi));
    bool inside = true;
    for (const auto& wall : room.walls) inside = inside && geometry::value_at(wall.line, p) > margin;
    if (inside) return p;
  }
}

inline Direction random_direction(Space space, const Point& at, Random& random, double steep = 1) {
  const double angle = random.between(0, 2 * kPi);
  const double m = steep * random.between(-1, 1), c = std::sqrt(1 - m * m);
  const auto v = geometry::translation_to(space, at) * Tangent(0, std::cos(angle), std::sin(angle));
  return {c * v, m};
}

inline Ray random_ray(const place::Interior& placed, Random& random, double steep = 1) {
  const Point p = random_point(placed.polygon, random);
  return ray_from(placed.polygon.space, {p, random.between(0, placed.height)}, random_direction(placed.polygon.space, p, random, steep));
}

/// Random triangles with corners anywhere within `size` of a random point.
inline place::PlacedMesh soup_of(const place::Interior& placed, int count, double size, Random& random) {
  place::PlacedMesh mesh;
  const Space space = placed.polygon.space;
  for (int i = 0; i < count; ++i) {
    const Point middle = random_point(placed.polygon, random);
    const double z = random.between(0, placed.height);
    const auto move = geometry::translation_to(space, middle);
    for (std::uint32_t j = 0; j < 3; ++j) {
      Point p = move * at_polar(space, size * random.unit(), random.between(0, 2 * kPi));
      for (int trial = 0; trial < 100 && [&] {
             for (const auto& wall : placed.polygon.walls)
               if (geometry::value_at(wall.line, p) <= 0) return true;
             return false;
           }(); ++trial)
        p = move * at_polar(space, size * random.unit(), random.between(0, 2 * kPi));
      mesh.floor.push_back(p);
      mesh.z.push_back(std::min(placed.height, std::max(0.0, z + random.between(-size, size))));
    }
    const auto first = static_cast<std::uint32_t>(3 * i);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  mesh.style.assign(mesh.triangles.size(), 0);
  return mesh;
}

/// The brute-force twin of closest_triangle: `intersect` on every triangle.
inline BvhHit try_all(Space space, const SceneTriangles& soup, const Ray& ray, double t_max) {
  BvhHit best;
  best.t = t_max;
  const RayPlane plane = plane_of(space, ray);
  for (std::uint32_t i = 0; i < soup.corners.size(); ++i) {
    const auto& v = soup.corners[i];
    const TriangleHit hit = intersect(plane, soup.vertices[v[0]], soup.vertices[v[1]], soup.vertices[v[2]], best.t);
    if (hit.found) best = {i, hit.t, {hit.b[0], hit.b[1], hit.b[2]}};
  }
  return best;
}

}  // namespace orbc::trace::testing
