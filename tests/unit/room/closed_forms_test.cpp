#include "compiler/geometry/predicates.h"
#include "compiler/room/summary.h"
#include "tests/unit/room/rooms.h"

namespace orbc::room::testing {
namespace {

constexpr double kPi = std::numbers::pi;

TEST_CASE("one mirror of the sphere is the equator of a half sphere", "[room]") {
  const Room room = made(orbifold_of({}));
  CHECK(room.space == Space::spherical);
  CHECK(room.corners.empty());
  REQUIRE(room.walls.size() == 1);
  CHECK(room.walls[0].length == Approx(2 * kPi));
  CHECK(room.area == Approx(2 * kPi));
  CHECK(room.inradius == Approx(kPi / 2));
  CHECK(room.certificate.convex);
  CHECK(room.certificate.closure_residual < 1e-15);
  CHECK(room.certificate.area_residual < 1e-14);
  CHECK(geometry::contains(room.outline, geometry::point_from_log(Space::spherical, {1.5, 0.4})) == geometry::Containment::inside);
  CHECK(geometry::contains(room.outline, geometry::point_from_log(Space::spherical, {1.6, 0.4})) == geometry::Containment::outside);
  const Point quarter = point_on_wall(room, 0, kPi / 2);
  CHECK(geometry::distance(Space::spherical, quarter, Point(0, 0, 1)) < 1e-15);
  CHECK(geometry::distance(Space::spherical, reflection_in_wall(room, 0) * Point(), Point(-1, 0, 0)) < 1e-15);
}

TEST_CASE("two mirrors of the sphere are a lune with its corners at ±x", "[room]") {
  for (const int k : {2, 3, 4, 7, 1000}) {
    const Room room = made(orbifold_of({k, k}));
    check_room(room);
    CHECK(room.walls[0].length == Approx(kPi));
    CHECK(room.area == Approx(2 * kPi / k));
    CHECK(room.inradius == Approx(kPi / (2 * k)));
    CHECK(room.circumradius == Approx(kPi / 2));
    CHECK(room.corners[1].at.x == -1);
    CHECK(room.outline.size() == 4);
    CHECK(geometry::contains(room.outline, Point()) == geometry::Containment::inside);
    CHECK(geometry::distance(Space::spherical, point_on_wall(room, 0, kPi / 2),
                             geometry::point_from_log(Space::spherical, {0, kPi / (2 * k)})) < 1e-15);
  }
}

TEST_CASE("the strip has two mirrors and two plain ends", "[room]") {
  scene::Shape shape;
  shape.scale = 0.5;
  shape.strip_length = 6;
  const Room room = made({{}, true}, shape);
  check_room(room);
  REQUIRE(room.walls.size() == 4);
  CHECK(room.walls[0].reflects);
  CHECK_FALSE(room.walls[1].reflects);
  CHECK(room.walls[2].reflects);
  CHECK_FALSE(room.walls[3].reflects);
  CHECK(room.walls[0].length == Approx(3));
  CHECK(room.walls[1].length == Approx(1));
  CHECK(room.area == Approx(3));
  CHECK(room.inradius == 0);
  // The two mirrors generate the translation by twice their distance.
  const std::vector<geometry::Isometry> mirrors = generators(room);
  REQUIRE(mirrors.size() == 2);
  CHECK(geometry::distance(Space::euclidean, (mirrors[0] * mirrors[1]) * Point(), Point()) == Approx(2));
}

TEST_CASE("the half strip has two parallel mirrors, one across, and one plain end", "[room]") {
  scene::Shape shape;
  shape.scale = 0.5;
  shape.strip_length = 6;
  const Room room = made({{2, 2}, true}, shape);
  check_room(room);
  REQUIRE(room.walls.size() == 4);
  CHECK(room.walls[0].length == Approx(1));  // the mirror across, between the two corners of order 2
  CHECK(room.walls[1].length == Approx(3));
  for (const std::size_t wall : {0, 1, 3}) CHECK(room.walls[wall].reflects);
  CHECK_FALSE(room.walls[2].reflects);
  const std::vector<geometry::Isometry> mirrors = generators(room);
  REQUIRE(mirrors.size() == 3);
  // The mirror across turns back, the parallel ones move on by twice their distance.
  CHECK(geometry::distance(Space::euclidean, (mirrors[0] * mirrors[0]) * Point(), Point()) < 1e-15);
  CHECK(geometry::distance(Space::euclidean, mirrors[0] * Point(), Point()) == Approx(3));
  CHECK(geometry::distance(Space::euclidean, (mirrors[1] * mirrors[2]) * Point(), Point()) == Approx(2));
}

TEST_CASE("rectangles have the wanted aspect, and their largest circle the wanted radius", "[room]") {
  for (const double aspect : {0.25, 1.0, 1.5, 8.0}) {
    scene::Shape shape;
    shape.scale = 3;
    shape.aspect = aspect;
    const Room room = made(orbifold_of({2, 2, 2, 2}), shape);
    check_room(room);
    CHECK(room.walls[0].length / room.walls[1].length == Approx(aspect));
    CHECK(std::min(room.walls[0].length, room.walls[1].length) == Approx(6));
    CHECK(room.inradius == (aspect == 1 ? 3.0 : 0.0));
    CHECK(room.area == Approx(room.walls[0].length * room.walls[1].length));
    shape.kind = scene::ShapeKind::paper;
    CHECK(made(orbifold_of({2, 2, 2, 2}), shape).walls[0].length == room.walls[0].length);
  }
}

TEST_CASE("Euclidean rooms scale with their inradius, tiny and huge", "[room]") {
  for (const double scale : {1e-9, 1e-3, 1.0, 12.5, 1e9})
    for (const std::vector<Order>& corners :
         {std::vector<Order>{3, 3, 3}, {4, 2, 4}, {6, 3, 2}, {2, 2, 2, 2}, {Order(3, 2), Order(3, 2), 3, 3}}) {
      scene::Shape shape;
      shape.scale = scale;
      const Room room = made(orbifold_of(corners), shape);
      check_room(room);
      CHECK(room.inradius == scale);
      double perimeter = 0;
      for (const Wall& wall : room.walls) {
        CHECK(wall.line.w == Approx(scale).epsilon(1e-15));
        perimeter += wall.length;
      }
      CHECK(room.area == Approx(perimeter * scale / 2).epsilon(1e-14));
    }
}

TEST_CASE("rooms with real corners: the double-headed room and regular polygons", "[room]") {
  const Room heads = made(orbifold_of({Order(3, 2), 12, 12}));
  CHECK(heads.corners[0].angle == Approx(2 * kPi / 3).epsilon(1e-15));
  check_room(heads);
  check_room(made(orbifold_of({Order(5, 2), Order(5, 2), Order(5, 2), Order(5, 2)})));
  check_room(made(orbifold_of({Order(5, 2), Order(5, 2), Order(5, 2), Order(5, 2)}), shape_of(scene::ShapeKind::paper)));
  // The face of a cube on the sphere, a regular Euclidean hexagon, a spherical pentagon (dodecahedron).
  const Room cube = made(orbifold_of({Order(3, 2), Order(3, 2), Order(3, 2), Order(3, 2)}));
  check_room(cube);
  CHECK(cube.area == Approx(4 * kPi / 6));
  CHECK(cube.inradius == Approx(kPi / 4));
  const Room hexagon = made(orbifold_of(std::vector<Order>(6, Order(3, 2))));
  check_room(hexagon);
  CHECK(hexagon.walls[3].length == Approx(2 / std::sqrt(3.0)));
  const Room dodecahedron = made(orbifold_of(std::vector<Order>(5, Order(3, 2))));
  check_room(dodecahedron);
  CHECK(dodecahedron.area == Approx(4 * kPi / 12));
}

TEST_CASE("a long spherical triangle whose narrow corner sees the circle's touching points beyond a right angle", "[room]") {
  // A lune of 20° cut across near one tip: the other tip is more than a quarter turn away from the touching points.
  const Room room = made(orbifold_of({Order(180, 20), Order(180, 99), Order(180, 97)}));
  check_room(room);
  CHECK(room.walls[0].length > 2);
  CHECK(room.outline.size() > 3);
  CHECK(geometry::is_convex(room.outline));
}

TEST_CASE("the summary lists lengths, moduli and the translational cover", "[room]") {
  CHECK(summarise(made(orbifold_of({2, 2, 2, 2}))).translational_cover == 4);
  CHECK(summarise(made(orbifold_of({3, 3, 3}))).translational_cover == 6);
  CHECK(summarise(made(orbifold_of({4, 2, 4}))).translational_cover == 8);
  CHECK(summarise(made(orbifold_of({3, 2, 6}))).translational_cover == 12);
  CHECK(summarise(made(orbifold_of({2, 3, 7}))).translational_cover == 0);
  CHECK(summarise(made({{}, true})).translational_cover == 0);
  CHECK(summarise(made({{2, 2}, true})).translational_cover == 0);
  CHECK(summarise(made(orbifold_of({2, 2, 2, 2}))).moduli_names == std::vector<std::string>{"aspect"});
  const Summary six = summarise(made(orbifold_of({2, 2, 2, 2, 2, 2})));
  CHECK(six.moduli == 3);
  CHECK(six.moduli_names == std::vector<std::string>{"cut of walls 2 and 6", "cut of walls 3 and 6", "cut of walls 4 and 6"});
  CHECK(six.sides.size() == 6);
  CHECK(six.angles[3] == Approx(kPi / 2));
  CHECK(summarise(made(orbifold_of({2, 3, 7}))).moduli == 0);
  CHECK(summarise(made(orbifold_of({}))).sides.size() == 1);
}

TEST_CASE("rooms too wide to be drawn are summarised all the same", "[room]") {
  std::vector<Order> orders;
  for (int i = 0; i < 40; ++i) orders.emplace_back(2 + i);
  const scene::Shape paper = shape_of(scene::ShapeKind::paper);
  CHECK(failure(orbifold_of(orders), paper) == "room.no-certificate");
  const Result<Summary> summary = summarise(orbifold_of(orders), paper);
  REQUIRE(summary);
  CHECK_FALSE(summary->certified);
  REQUIRE(summary->sides.size() == 40);
  // Wall 38 lies between the last two cuts: quad *22k₃k₄ at corners 39 and 40 (orders 40 and 41), pentagon *2222k at corner 38 (order 39).
  const double c = std::cosh(1.4), s = std::sinh(1.4), c38 = std::cos(kPi / 39), c39 = std::cos(kPi / 40), c40 = std::cos(kPi / 41);
  const double pentagon = std::asinh((c + c38 * c) / (s * std::sin(kPi / 39))),
               quad = std::asinh((c40 + c39 * c) / (std::sin(kPi / 40) * s));
  CHECK(summary->sides[37] == Approx(pentagon + quad).epsilon(1e-14));
  CHECK(summary->sides[38] == Approx(std::acosh((c + c39 * c40) / (std::sin(kPi / 40) * std::sin(kPi / 41)))).epsilon(1e-14));
  CHECK(summarise(orbifold_of({2, 3, 7}))->certified);
  CHECK_FALSE(summarise(orbifold_of({2, 3})).has_value());
}

}  // namespace
}  // namespace orbc::room::testing
