#include <limits>

#include "tests/unit/room/rooms.h"

namespace orbc::room::testing {
namespace {

using scene::Shape;
using scene::ShapeKind;

TEST_CASE("what closes in no space is refused", "[room]") {
  CHECK(failure(orbifold_of({3})) == "notation.bad-orbifold");
  CHECK(failure(orbifold_of({2, 3})) == "notation.bad-orbifold");
  CHECK(failure(orbifold_of({Order(1, 2), 3, 3})) == "notation.order-out-of-range");
  CHECK(failure(orbifold_of({1, 3, 3})) == "notation.order-out-of-range");
  CHECK(failure(orbifold_of({0, 3, 3})) == "notation.order-out-of-range");
  CHECK(failure(orbifold_of({Order(-2), 3, 3})) == "notation.order-out-of-range");
  CHECK(failure(orbifold_of({Order(10, 9), Order(10, 9), 50})) == "notation.bad-orbifold");
  CHECK(failure(orbifold_of({Order(10, 9), Order(10, 9), Order(10, 9)})).empty());
}

TEST_CASE("corners that are no integers need permission", "[room]") {
  CHECK(failure(orbifold_of({Order(3, 2), 12, 12}), {}, false) == "notation.non-orbifold-corner");
  CHECK(failure(orbifold_of({2, 3, 7}), {}, false).empty());
}

TEST_CASE("spherical quads that no circle touches are refused, not guessed", "[room]") {
  // Two corners of nearly 180°, two narrow ones beside each other.
  CHECK(failure(orbifold_of({Order(100, 99), Order(100, 99), Order(100, 99), 60})) == "room.no-such-shape");
  CHECK(failure(orbifold_of({Order(20, 19), Order(3, 2), Order(20, 19), 50})) == "room.no-such-shape");
}

TEST_CASE("cuts are checked one by one", "[room]") {
  const notation::Orbifold hexagon = orbifold_of({2, 2, 2, 2, 2, 2});
  const auto with = [&](std::vector<scene::Cut> cuts) {
    Shape shape;
    shape.kind = ShapeKind::paper;
    shape.cuts = std::move(cuts);
    return failure(hexagon, shape);
  };
  CHECK(with({{{1, 3}, 1}, {{1, 4}, 1}, {{1, 5}, 1}}).empty());
  CHECK(with({{{4, 1}, 1}}).empty());
  CHECK(with({{{1, 3}, 1}, {{3, 5}, 1}, {{5, 1}, 1}}).empty());
  CHECK(with({{{1, 2}, 1}}) == "room.bad-cuts");
  CHECK(with({{{6, 1}, 1}}) == "room.bad-cuts");
  CHECK(with({{{0, 3}, 1}}) == "room.bad-cuts");
  CHECK(with({{{3, 7}, 1}}) == "room.bad-cuts");
  CHECK(with({{{3, 3}, 1}}) == "room.bad-cuts");
  CHECK(with({{{1, 3}, 1}, {{3, 1}, 1}}) == "room.bad-cuts");
  CHECK(with({{{1, 4}, 1}, {{2, 5}, 1}}) == "room.bad-cuts");
  for (const double length : {0.0, -1.0, 1e9, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    CHECK(with({{{1, 3}, length}}) == "room.bad-cuts");
    Shape shape;
    shape.kind = ShapeKind::paper;
    shape.cut = length;
    CHECK(failure(hexagon, shape) == "room.bad-cuts");
  }
}

TEST_CASE("all mistakes among the cuts are told at once", "[room]") {
  Shape shape;
  shape.kind = ShapeKind::paper;
  shape.cuts = {{{1, 2}, 1}, {{1, 4}, -1}, {{9, 2}, 1}};
  const Result<Room> room = realise(orbifold_of({2, 2, 2, 2, 2, 2}), shape);
  REQUIRE_FALSE(room);
  CHECK(room.error().size() == 3);
}

TEST_CASE("lengths that no room has are refused with the tangential ones as hint", "[room]") {
  const notation::Orbifold pentagon = orbifold_of({2, 2, 2, 2, 2});
  const auto with = [&](std::map<int, double> lengths) {
    Shape shape;
    shape.kind = ShapeKind::lengths;
    shape.lengths = std::move(lengths);
    return failure(pentagon, shape);
  };
  CHECK(with({{1, 1.0}, {3, 1.1}}).empty());
  CHECK(with({{1, 1.0}, {2, 1.2}}).empty());
  // Two neighbouring sides of a right-angled pentagon need sinh a · sinh b > 1.
  CHECK(with({{1, 0.5}, {2, 0.5}}) == "room.no-such-shape");
  CHECK(with({{1, 1.0}}) == "room.bad-lengths");
  CHECK(with({}) == "room.bad-lengths");
  CHECK(with({{1, 1.0}, {2, 1.0}, {3, 1.0}}) == "room.bad-lengths");
  CHECK(with({{0, 1.0}, {2, 1.0}}) == "room.bad-lengths");
  CHECK(with({{1, -1.0}, {2, 1.0}}) == "room.bad-lengths");
  CHECK(with({{1, std::numeric_limits<double>::quiet_NaN()}, {2, 1.0}}) == "room.bad-lengths");
  Shape shape;
  shape.kind = ShapeKind::lengths;
  shape.lengths = {{1, 0.5}, {2, 0.5}};
  CHECK(realise(pentagon, shape).error()[0].hint.find("1: 1.0613") != std::string::npos);
}

TEST_CASE("relations of lengths that cannot hold are refused", "[room]") {
  const auto with = [&](std::map<int, double> lengths, std::vector<scene::LengthRelation> relations) {
    Shape shape;
    shape.kind = ShapeKind::lengths;
    shape.lengths = std::move(lengths);
    shape.relations = std::move(relations);
    return failure(orbifold_of({2, 2, 2, 2, 2}), shape);
  };
  CHECK(with({{1, 1.0}}, {{2, 1.2, 1}}).empty());
  CHECK(with({{1, 1.0}}, {}) == "room.bad-lengths");
  CHECK(with({{1, 1.0}}, {{2, 1, 6}}) == "room.bad-lengths");
  CHECK(with({{1, 1.0}}, {{2, 1, 2}}) == "room.bad-lengths");
  CHECK(with({}, {{1, 1, 2}, {2, 1, 1}}) == "room.bad-lengths");
  CHECK(with({{1, 1.0}}, {{2, -1, 1}}) == "room.bad-lengths");
  CHECK(with({{1, 0.5}}, {{2, 1, 1}}) == "room.no-such-shape");
}

TEST_CASE("walls may be as long as others, or in a ratio to them", "[room]") {
  Shape shape;
  shape.kind = ShapeKind::lengths;
  const auto length = [](const Room& room, int wall) { return room.walls[static_cast<std::size_t>(wall - 1)].length; };
  // Right-angled pentagon, as below: sinh a sinh b = cosh d. With a = b both follow from d in closed form.
  shape.lengths = {{4, 1.2}};
  shape.relations = {{1, 1, 2}};
  const Room equal = made(orbifold_of({2, 2, 2, 2, 2}), shape);
  check_room(equal);
  CHECK(length(equal, 4) == Approx(1.2).epsilon(1e-15));
  CHECK(length(equal, 1) == Approx(std::asinh(std::sqrt(std::cosh(1.2)))).epsilon(1e-14));
  CHECK(length(equal, 2) == Approx(length(equal, 1)).epsilon(1e-15));
  // No length is given: the ratios fix the room.
  shape.lengths.clear();
  shape.relations = {{1, 1, 2}, {4, 1.3, 1}};
  const Room ratios = made(orbifold_of({2, 2, 2, 2, 2}), shape);
  check_room(ratios);
  const double a = length(ratios, 1);
  CHECK(length(ratios, 4) == Approx(1.3 * a).epsilon(1e-15));
  CHECK(std::sinh(a) * std::sinh(a) == Approx(std::cosh(1.3 * a)).epsilon(1e-14));
  // A chain that ends in a length is that length; far from the tangential room the way there is taken in steps.
  shape.lengths = {{1, 2.5}};
  shape.relations = {{3, 0.5, 5}, {5, 1.6, 1}, {6, 1, 7}};
  const Room chain = made(orbifold_of({2, 3, 2, 4, 2, 3, 2}), shape);
  check_room(chain);
  CHECK(length(chain, 5) == Approx(4.0).epsilon(1e-15));
  CHECK(length(chain, 3) == Approx(2.0).epsilon(1e-15));
  CHECK(length(chain, 6) == Approx(length(chain, 7)).epsilon(1e-14));
}

TEST_CASE("two neighbouring sides of a right-angled pentagon fix the opposite one", "[room]") {
  Shape shape;
  shape.kind = ShapeKind::lengths;
  shape.lengths = {{1, 1.3}, {2, 0.9}};
  const Room room = made(orbifold_of({2, 2, 2, 2, 2}), shape);
  check_room(room);
  // sinh a sinh b = cosh d for neighbours a, b and the opposite side d (Buser, Geometry and Spectra of Compact Riemann Surfaces, 2.3.4).
  CHECK(std::cosh(room.walls[3].length) == Approx(std::sinh(1.3) * std::sinh(0.9)).epsilon(1e-14));
}

TEST_CASE("settings that a room cannot use are mistakes", "[room]") {
  Shape scaled, stretched, striped, cut, sized;
  scaled.scale = 2;
  stretched.aspect = 2;
  striped.strip_length = 3;
  cut.cuts = {{{1, 3}, 1}};
  sized.lengths = {{1, 1}};
  const notation::Orbifold pentagon = orbifold_of({2, 2, 2, 2, 2}), square = orbifold_of({2, 2, 2, 2});
  CHECK(failure(pentagon, scaled) == "room.unused-setting");
  CHECK(failure(square, scaled).empty());
  CHECK(failure(pentagon, stretched) == "room.unused-setting");
  CHECK(failure(orbifold_of({3, 3, 3}), stretched) == "room.unused-setting");
  CHECK(failure(square, striped) == "room.unused-setting");
  CHECK(failure({{}, true}, striped).empty());
  CHECK(failure(pentagon, cut) == "room.unused-setting");
  CHECK(failure(pentagon, sized) == "room.unused-setting");
  cut.kind = ShapeKind::paper;
  sized.kind = ShapeKind::lengths;
  CHECK(failure(square, cut) == "room.shape-needs-hyperbolic");
  CHECK(failure(square, sized) == "room.shape-needs-hyperbolic");
  CHECK(failure(orbifold_of({2, 3, 5}), sized) == "room.shape-needs-hyperbolic");
  CHECK(failure(orbifold_of({2, 3, 5}), shape_of(ShapeKind::paper)).empty());
  CHECK(failure(orbifold_of({2, 3, 7}), shape_of(ShapeKind::lengths)).empty());
}

TEST_CASE("sizes that are no sizes are refused", "[room]") {
  for (const double bad : {0.0, -1.0, 1e300, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Shape shape;
    shape.scale = bad;
    CHECK(failure(orbifold_of({3, 3, 3}), shape) == "room.bad-size");
    shape = {};
    shape.aspect = bad;
    CHECK(failure(orbifold_of({2, 2, 2, 2}), shape) == "room.bad-size");
    shape = {};
    shape.strip_length = bad;
    CHECK(failure({{}, true}, shape) == "room.bad-size");
  }
}

TEST_CASE("a room wider than double precision carries is refused with a reason", "[room]") {
  Shape shape;
  shape.kind = ShapeKind::paper;
  shape.cut = 0.05;
  const Result<Room> room = realise(orbifold_of(std::vector<Order>(40, 3)), shape);
  REQUIRE_FALSE(room);
  CHECK(room.error()[0].code == "room.no-certificate");
  CHECK(room.error()[0].message.find("curvature radii") != std::string::npos);
}

TEST_CASE("errors point to the shape of the scene", "[room]") {
  Shape shape;
  shape.span = {std::make_shared<SourceText>(SourceText{"kitchen.yaml", "room: {shape: paper}"}), 1, 8, 5};
  shape.scale = 0;
  CHECK(realise(orbifold_of({2, 3, 7}), shape).error()[0].span.line == 1);
}

}  // namespace
}  // namespace orbc::room::testing
