#pragma once
#include <catch2/catch.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "compiler/room/realise.h"
#include "tests/reference/rooms.h"
#include "tests/unit/geometry/random_geometry.h"

namespace orbc::room::testing {

using geometry::Point;
using geometry::Space;
using geometry::testing::Random;

/// The order of a corner, p or p/q.
struct Order {
  std::int64_t p = 2, q = 1;
  Order(std::int64_t whole) : p(whole) {}
  Order(std::int64_t numerator, std::int64_t denominator) : p(numerator), q(denominator) {}
  friend bool operator==(const Order& a, const Order& b) { return a.p == b.p && a.q == b.q; }
};

inline notation::Orbifold orbifold_of(const std::vector<Order>& corners) {
  notation::Orbifold orbifold;
  for (const Order& order : corners) {
    Rational value = order.p;
    value /= order.q;
    orbifold.corners.push_back(value);
  }
  return orbifold;
}

inline notation::Orbifold orbifold_of_reference(const ReferenceRoom& room) {
  std::vector<Order> orders;
  for (const auto& [p, q] : room.orders) orders.emplace_back(p, q);
  return orbifold_of(orders);
}

inline Room made(const notation::Orbifold& orbifold, const scene::Shape& shape = {}) {
  Result<Room> room = realise(orbifold, shape, true);
  if (!room) FAIL(to_text(room.error()));
  return *std::move(room);
}

inline scene::Shape shape_of(scene::ShapeKind kind) {
  scene::Shape shape;
  shape.kind = kind;
  return shape;
}

inline std::string failure(const notation::Orbifold& orbifold, const scene::Shape& shape = {}, bool allow = true) {
  const Result<Room> room = realise(orbifold, shape, allow);
  return room ? "" : room.error().front().code;
}

/// What every realised room promises, measured in ways that do not follow the code.
inline void check_room(const Room& room) {
  const std::size_t n = room.corners.size();
  REQUIRE(room.certificate.convex);
  CHECK(room.walls.size() == (n == 0 ? 1 : n));
  CHECK(room.outline.size() == room.outline_wall.size());
  // One ulp of a far hyperbolic coordinate is worth e^(2r).
  const double size = room.space == Space::hyperbolic  ? std::cosh(room.circumradius)
                      : room.space == Space::euclidean ? room.circumradius
                                                       : 1;
  const double e = 64 * 0x1p-52 * size * (room.space == Space::hyperbolic ? size : 1);
  for (std::size_t i = 0; i < n; ++i) {
    const Wall &wall = room.walls[i], &before = room.walls[(i + n - 1) % n];
    const Point &p = room.corners[i].at, &q = room.corners[(i + 1) % n].at;
    CHECK(geometry::distance(room.space, wall.start, p) == 0);
    CHECK(std::fabs(geometry::value_at(wall.line, p)) < e);
    CHECK(std::fabs(geometry::value_at(before.line, p)) < e);
    CHECK(geometry::value_at(wall.line, Point()) > 0);
    CHECK(std::fabs(geometry::distance(room.space, p, q) - wall.length) < e);
    CHECK(std::fabs(geometry::distance(room.space, point_on_wall(room, static_cast<int>(i), wall.length), q)) < e);
    CHECK(std::fabs(geometry::distance(room.space, point_on_wall(room, static_cast<int>(i), 0), p)) < e);
    CHECK(std::fabs(geometry::value_at(wall.line, geometry::point_along(room.space, p, wall.along, wall.length / 3))) <
          e * (1 + std::exp(wall.length)));
  }
  if (n > 0) {
    CHECK(std::fabs(room.corners[0].at.y) < 1e-15);
    CHECK(room.corners[0].at.x > 0);
  }
}

}  // namespace orbc::room::testing
