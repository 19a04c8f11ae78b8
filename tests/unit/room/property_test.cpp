#include <algorithm>

#include "compiler/geometry/predicates.h"
#include "compiler/room/certificate.h"
#include "tests/unit/room/rooms.h"

namespace orbc::room::testing {
namespace {

using geometry::Isometry;

// A seeded good orbifold with up to 40 corners; most orders small, some up to `largest`.
notation::Orbifold random_orbifold(Random& random, int most, double largest) {
  const int n = 3 + static_cast<int>(random.uniform(0, most - 2));
  std::vector<Order> orders;
  for (int i = 0; i < n; ++i)
    orders.emplace_back(random.uniform(0, 1) < 0.5 ? 2 + static_cast<int>(random.uniform(0, 5))
                                                   : static_cast<int>(std::exp(random.uniform(std::log(2.0), std::log(largest)))));
  return orbifold_of(orders);
}

void check_relations(const Room& room, double precision) {
  const std::size_t n = room.corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Isometry a = reflection_in_wall(room, static_cast<int>((i + n - 1) % n)), b = reflection_in_wall(room, static_cast<int>(i));
    const Rational& k = room.orbifold.corners[i];
    if (denominator(k) != 1) continue;
    const int order = static_cast<int>(numerator(k));
    Isometry power = geometry::identity(room.space);
    for (int j = 0; j < order; ++j) power = geometry::renormalised(power * (a * b));
    CHECK(geometry::difference(a * a, geometry::identity(room.space)) < precision);
    CHECK(geometry::difference(power, geometry::identity(room.space)) < precision);
  }
}

TEST_CASE("group relations close to 1e-12", "[room]") {
  for (const std::vector<Order>& corners : {std::vector<Order>{2, 3, 7},
                                            {2, 3, 5},
                                            {3, 3, 3},
                                            {2, 4, 4},
                                            {2, 3, 6},
                                            {2, 2, 2, 2},
                                            {2, 2, 2, 2, 2},
                                            {2, 3, 2, 3},
                                            {5, 5},
                                            {3, 3, 3, 3, 3, 3},
                                            {2, 2, 9}}) {
    check_relations(made(orbifold_of(corners)), 1e-12);
    check_relations(made(orbifold_of(corners), shape_of(scene::ShapeKind::paper)), 1e-12);
  }
  // Ten corners: the paper's fan reaches 5.2 radii, the tangential room 4.
  check_relations(made(orbifold_of({2, 3, 4, 5, 6, 7, 8, 9, 10, 11})), 1e-9);
}

TEST_CASE("random orbifolds up to 40 corners are realised with certificates", "[room]") {
  Random random(61);
  for (int i = 0; i < 150; ++i) {
    const notation::Orbifold orbifold = random_orbifold(random, i < 100 ? 12 : 40, 1000);
    const Room room = made(orbifold);
    check_room(room);
    const double size = room.space == Space::hyperbolic ? std::cosh(room.circumradius) : 1;
    CHECK(room.certificate.closure_residual < 8e-16 * size * size);
    CHECK(room.certificate.side_residual < 8e-16 * size * size);
    for (const Wall& wall : room.walls)
      CHECK(geometry::signed_distance(room.space, wall.line, Point()) == Approx(room.inradius).epsilon(1e-13 * size));
  }
}

TEST_CASE("random rooms of the paper with random cuts are realised with certificates", "[room]") {
  Random random(62);
  int realised = 0, refused = 0;
  for (int i = 0; i < 100; ++i) {
    const notation::Orbifold orbifold = random_orbifold(random, 14, 30);
    if (orbifold.corners.size() < 5) continue;
    scene::Shape shape = shape_of(scene::ShapeKind::paper);
    shape.cut = random.uniform(0.3, 2.5);
    const int n = static_cast<int>(orbifold.corners.size());
    // One named cut, the regions beside it fanned.
    const int a = 1 + static_cast<int>(random.uniform(0, n)), b = (a + 1 + static_cast<int>(random.uniform(0, n - 3))) % n + 1;
    shape.cuts.push_back({{a, b}, random.uniform(0.2, 3)});
    const Result<Room> room = realise(orbifold, shape);
    if (!room) {
      // Only for its size: there is always such a polygon.
      CHECK(room.error()[0].code == "room.no-certificate");
      CHECK(room.error()[0].message.find("curvature radii") != std::string::npos);
      ++refused;
      continue;
    }
    check_room(*room);
    ++realised;
  }
  CHECK(realised > 60);
  CHECK(refused < 12);
}

TEST_CASE("forty corners, regular and irregular", "[room]") {
  const Room regular = made(orbifold_of(std::vector<Order>(40, 2)));
  check_room(regular);
  // cosh(side/2) = cos(π/N)/sin(α/2): closed form of the regular polygon.
  const double side = 2 * std::acosh(std::cos(std::numbers::pi / 40) / std::sin(std::numbers::pi / 4));
  for (const Wall& wall : regular.walls) CHECK(wall.length == Approx(side).epsilon(1e-14));
  CHECK(regular.certificate.angle_residual < 1e-12);
  CHECK(regular.certificate.closure_residual < 1e-12);
  CHECK(regular.certificate.side_residual < 1e-12);
  CHECK(regular.certificate.area_residual < 1e-12);
  std::vector<Order> orders;
  for (int i = 0; i < 40; ++i) orders.emplace_back(2 + (i * 7) % 5);
  const notation::Orbifold irregular = orbifold_of(orders);
  const Room room = made(irregular);
  check_room(room);
  CHECK(room.certificate.angle_residual < 1e-12);
  CHECK(room.certificate.side_residual < 2e-12);
  scene::Shape paper = shape_of(scene::ShapeKind::paper);
  paper.cut = 2.5;
  check_room(made(irregular, paper));
}

TEST_CASE("turning and mirroring the corner list turns and mirrors the room", "[room]") {
  Random random(63);
  for (int i = 0; i < 60; ++i) {
    const notation::Orbifold orbifold = random_orbifold(random, 12, 20);
    const std::size_t n = orbifold.corners.size();
    const Room room = made(orbifold);
    notation::Orbifold turned = orbifold, mirrored = orbifold;
    std::rotate(turned.corners.begin(), turned.corners.begin() + 1, turned.corners.end());
    std::reverse(mirrored.corners.begin(), mirrored.corners.end());
    const Room after = made(turned), mirror = made(mirrored);
    for (std::size_t j = 0; j < n; ++j) {
      CHECK(after.walls[j].length == Approx(room.walls[(j + 1) % n].length).epsilon(1e-15));
      // Corner j of the mirrored list is corner n−1−j, so its wall j is the old wall n−2−j.
      CHECK(mirror.walls[j].length == Approx(room.walls[(2 * n - 2 - j) % n].length).epsilon(1e-15));
    }
  }
}

TEST_CASE("tangential rooms keep the symmetry of their corners", "[room]") {
  for (const std::vector<Order>& corners : {std::vector<Order>{2, 3, 2, 3, 2, 3}, {5, 4, 5, 4}, {2, 7, 3, 2, 7, 3}}) {
    const Room room = made(orbifold_of(corners));
    const std::size_t n = corners.size();
    for (std::size_t period = 1; period < n; ++period) {
      bool symmetric = n % period == 0;
      for (std::size_t i = 0; i < n && symmetric; ++i) symmetric = corners[i] == corners[(i + period) % n];
      if (!symmetric) continue;
      const Isometry turn = geometry::rotation(room.space, 2 * std::numbers::pi * static_cast<double>(period) / static_cast<double>(n));
      for (std::size_t i = 0; i < n; ++i)
        CHECK(geometry::distance(room.space, turn * room.corners[i].at, room.corners[(i + period) % n].at) < 1e-13);
    }
  }
}

TEST_CASE("rooms next to the border between the spaces are realised", "[room]") {
  // Huge orders, and real corners that miss the Euclidean triangle by 1e-3 … 1e-12 to both sides.
  for (const int k : {1000, 1000000}) {
    check_room(made(orbifold_of({2, 3, k})));
    check_room(made(orbifold_of({k, k, k})));
    check_room(made(orbifold_of({2, 2, k})));
  }
  for (const std::int64_t size : {1000ll, 1000000ll, 1000000000ll, 1000000000000ll})
    for (const int sign : {1, -1}) {
      const Order near(3 * size + sign, size);
      const Room room = made(orbifold_of({near, near, near}));
      CHECK(room.space == (sign > 0 ? Space::hyperbolic : Space::spherical));
      check_room(room);
      // Area = 2π|χ| and, this small, 3√3 r².
      CHECK(room.area == Approx(3 * std::sqrt(3.0) * room.inradius * room.inradius).epsilon(0.01));
      CHECK(room.certificate.angle_residual < 1e-14);
    }
}

TEST_CASE("given lengths are met and the rest is solved", "[room]") {
  Random random(64);
  for (int i = 0; i < 80; ++i) {
    // Lengths of a random room of the paper are lengths that exist.
    const notation::Orbifold orbifold = random_orbifold(random, 9, 12);
    const std::size_t n = orbifold.corners.size();
    if (n < 4 || made(orbifold).space != Space::hyperbolic) continue;
    scene::Shape paper = shape_of(scene::ShapeKind::paper);
    paper.cut = random.uniform(0.8, 2);
    const Room model = made(orbifold, paper);
    scene::Shape shape = shape_of(scene::ShapeKind::lengths);
    std::vector<int> walls;
    for (std::size_t j = 0; j < n; ++j) walls.push_back(static_cast<int>(j) + 1);
    while (walls.size() > n - 3)
      walls.erase(walls.begin() + static_cast<std::ptrdiff_t>(random.uniform(0, static_cast<double>(walls.size()))));
    for (const int wall : walls) shape.lengths[wall] = model.walls[static_cast<std::size_t>(wall - 1)].length;
    const Room room = made(orbifold, shape);
    check_room(room);
    // Rounded lengths are amplified by the size of the room.
    for (std::size_t j = 0; j < n; ++j)
      CHECK(room.walls[j].length == Approx(model.walls[j].length).margin(1e-13 * std::pow(std::cosh(model.circumradius), 3)));
    for (const int wall : walls) CHECK(room.walls[static_cast<std::size_t>(wall - 1)].length == Approx(shape.lengths[wall]).epsilon(1e-15));
  }
}

TEST_CASE("rooms with random real corners are certified or refused, in every space and shape", "[room]") {
  Random random(66);
  int made_rooms[3] = {}, refused = 0;
  for (int i = 0; i < 600; ++i) {
    const int n = 3 + static_cast<int>(random.uniform(0, 5));
    std::vector<Order> orders;
    for (int j = 0; j < n; ++j) {
      const auto q = static_cast<std::int64_t>(random.uniform(1, 50));
      orders.emplace_back(q + 1 + static_cast<std::int64_t>(random.uniform(0, static_cast<double>(i % 3 == 0 ? q : 4 * q))), q);
    }
    scene::Shape shape;
    shape.kind = i % 2 ? scene::ShapeKind::paper : scene::ShapeKind::tangential;
    const Result<Room> room = realise(orbifold_of(orders), shape, true);
    if (room) {
      check_room(*room);
      ++made_rooms[geometry::curvature(room->space) + 1];
      continue;
    }
    ++refused;
    const std::string& code = room.error()[0].code;
    INFO(room.error()[0].message);
    // Lines of nearly straight corners meet far out, or not between the wanted cuts; the circle around a spherical room may not exist.
    CHECK((code == "room.no-such-shape" || code == "notation.bad-orbifold"));
  }
  CHECK(made_rooms[0] > 100);
  CHECK(made_rooms[2] > 50);
  CHECK(refused < 300);
}

TEST_CASE("points on walls are on their walls, mirror images keep them", "[room]") {
  Random random(65);
  for (const std::vector<Order>& corners : {std::vector<Order>{2, 3, 7}, {2, 3, 5}, {2, 4, 4}, {2, 2, 2, 2, 2}, {3, 3}}) {
    const Room room = made(orbifold_of(corners), shape_of(scene::ShapeKind::paper));
    for (int wall = 0; wall < static_cast<int>(room.walls.size()); ++wall)
      for (int i = 0; i < 20; ++i) {
        const double s = random.uniform(0, room.walls[static_cast<std::size_t>(wall)].length);
        const Point p = point_on_wall(room, wall, s);
        CHECK(std::fabs(geometry::value_at(room.walls[static_cast<std::size_t>(wall)].line, p)) < 1e-14);
        CHECK(geometry::distance(room.space, p, room.walls[static_cast<std::size_t>(wall)].start) == Approx(s).margin(1e-13));
        CHECK(geometry::distance(room.space, reflection_in_wall(room, wall) * p, p) < 1e-13);
      }
  }
}

TEST_CASE("the certificate notices a room that was tampered with", "[room]") {
  const Room good = made(orbifold_of({2, 3, 2, 3}));
  CHECK(passes(good, certify(good)));
  for (int fault = 0; fault < 6; ++fault) {
    Room bad = good;
    if (fault == 0)
      bad.walls[1].line = geometry::normalised_line(bad.space, {bad.walls[1].line.w + 1e-9, bad.walls[1].line.x, bad.walls[1].line.y});
    if (fault == 1)
      bad.corners[2].at = geometry::point_from_log(bad.space, geometry::log_from_point(bad.space, bad.corners[2].at) * 1.000000001);
    if (fault == 2) bad.walls[0].length += 1e-9;
    if (fault == 3) bad.outline[1] = geometry::point_from_log(bad.space, geometry::log_from_point(bad.space, bad.outline[1]) * 1.000000001);
    if (fault == 4) std::reverse(bad.outline.begin(), bad.outline.end());
    if (fault == 5) bad.orbifold.corners[0] = 5;
    INFO("fault " << fault);
    CHECK_FALSE(passes(bad, certify(bad)));
  }
}

}  // namespace
}  // namespace orbc::room::testing
