#include "compiler/place/locate.h"

#include <catch2/catch.hpp>

#include "compiler/geometry/predicates.h"
#include "rooms.h"

using namespace orbc;
using namespace orbc::place;
using namespace orbc::place::test;
using geometry::Containment;
using geometry::Point;

namespace {

scene::Place at(decltype(scene::Place::floor) floor) {
  scene::Place place;
  place.floor = floor;
  return place;
}

}  // namespace

TEST_CASE("each way to name a place gives the same point", "[place]") {
  for (const std::string& notation : notations()) {
    CAPTURE(notation);
    const room::Room room = make_room(notation);
    const double r = 0.4 * (room.inradius > 0 ? room.inradius : 0.5);
    for (const double degrees : {0.0, 77.0, 200.0}) {
      const Point p = locate(at(scene::AtPolar{r, Angle::from_degrees(degrees)}), room).value();
      CHECK(geometry::distance(room.space, Point{}, p) == Approx(r).epsilon(1e-12));
      CHECK(std::fabs(std::remainder(std::atan2(p.y, p.x) - degrees * M_PI / 180, 2 * M_PI)) < 1e-12);
      const Point q = locate(at(scene::AtDisk{geometry::disk_from_point(room.space, p)}), room).value();
      CHECK(geometry::distance(room.space, p, q) < 1e-12);
      if (room.walls.size() < 2) continue;
      const double a = geometry::signed_distance(room.space, room.walls[0].line, p),
                   b = geometry::signed_distance(room.space, room.walls[1].line, p);
      const Point s = locate(at(scene::AtWalls{{1, 2}, {a, b}}), room).value();
      // In a lune two points fit.
      if (room.walls.size() == 2 && s.x * p.x < 0) CHECK(geometry::signed_distance(room.space, room.walls[0].line, s) == Approx(a));
      else CHECK(geometry::distance(room.space, p, s) < 1e-6);
    }
  }
}

TEST_CASE("xy goes along the x axis, then along the perpendicular, as far as it says", "[place]") {
  for (const std::string& notation : notations()) {
    CAPTURE(notation);
    const room::Room room = make_room(notation);
    const double k = geometry::curvature(room.space), r = 0.3 * (room.inradius > 0 ? room.inradius : 0.5);
    const geometry::Line x_axis = geometry::line_along(room.space, {}, {0, 1, 0});
    for (const auto& [x, y] : {std::pair{r, 0.5 * r}, {-r, r}, {0.7 * r, -r}, {0.0, r}, {r, 0.0}}) {
      CAPTURE(x, y);
      const Point p = locate(at(scene::AtXy{x, y}), room).value();
      // y is the signed distance from the axis, x where its foot stands on it.
      CHECK(geometry::signed_distance(room.space, x_axis, p) == Approx(y).margin(1e-14));
      const Point foot = geometry::foot(room.space, x_axis, p);
      CHECK((foot.x < 0 ? -1 : 1) * geometry::distance(room.space, Point{}, foot) == Approx(x).margin(1e-14));
      // Pythagoras of the space: cosκ(c) = cosκ(x)·cosκ(y).
      const double c = geometry::distance(room.space, Point{}, p);
      if (k == 0) CHECK(c == Approx(std::hypot(x, y)));
      else CHECK(geometry::cos_k(room.space, c) == Approx(geometry::cos_k(room.space, x) * geometry::cos_k(room.space, y)));
    }
  }
  const room::Room square = make_room("*2222");
  const Point p = locate(at(scene::AtXy{0.25, -0.5}), square).value();
  CHECK((p.x == 0.25 && p.y == -0.5));
  const auto outside = locate(at(scene::AtXy{0, 60}), make_room("*22222"));
  REQUIRE(!outside);
  CHECK(outside.error()[0].code == "place.outside-room");
}

TEST_CASE("a point at given distances from two walls has these distances", "[place]") {
  std::mt19937 random(11);
  for (const std::string& notation : notations()) {
    const room::Room room = make_room(notation);
    const int n = static_cast<int>(room.walls.size());
    for (int trial = 0; trial < 40 && n > 1; ++trial) {
      const Point p = random_point(room, random);
      const int i = trial % n, j = (i + 1 + trial / n % (n - 1)) % n;
      const double a = geometry::signed_distance(room.space, room.walls[i].line, p),
                   b = geometry::signed_distance(room.space, room.walls[j].line, p);
      if (a < 1e-6 || b < 1e-6) continue;
      const auto found = locate(at(scene::AtWalls{{i + 1, j + 1}, {a, b}}), room);
      CAPTURE(notation, i, j, a, b);
      if (!found && (notation == "**" || notation == "*22∞") && (i + j) % 2 == 0) continue;   // parallel walls
      if (!found && notation == "*2222" && (i + j) % 2 == 0) continue;
      REQUIRE(found);
      CHECK(geometry::signed_distance(room.space, room.walls[i].line, *found) == Approx(a).margin(1e-7));
      CHECK(geometry::signed_distance(room.space, room.walls[j].line, *found) == Approx(b).margin(1e-7));
    }
  }
}

TEST_CASE("towards the middle of a wall, as far as the room goes and no further", "[place]") {
  for (const std::string& notation : notations()) {
    CAPTURE(notation);
    const room::Room room = make_room(notation);
    for (std::size_t i = 0; i < room.walls.size(); ++i) {
      const Point middle = room::point_on_wall(room, static_cast<int>(i), room.walls[i].length / 2);
      const double far = geometry::distance(room.space, Point{}, middle);
      const int number = static_cast<int>(i) + 1;
      CHECK(distance_to_boundary(room, std::atan2(middle.y, middle.x)) == Approx(far).epsilon(1e-9));
      // On the wall itself the point is rounded into the room.
      CHECK(locate(at(scene::AtToward{false, number, far}), room).has_value());
      const auto beyond = locate(at(scene::AtToward{false, number, far + 0.01}), room);
      REQUIRE(!beyond);
      CHECK(beyond.error()[0].code == "place.outside-room");
      CHECK(beyond.error()[0].message.find("wall " + std::to_string(number)) != std::string::npos);
      // What the hint names can be taken as it stands.
      const std::string& hint = beyond.error()[0].hint;
      const std::size_t named = hint.find("ends at ");
      REQUIRE(named != std::string::npos);
      const double end = std::stod(hint.substr(named + 8));
      CHECK(end <= far * (1 + 1e-12));
      CHECK(end >= 0.998 * far);
      CHECK(locate(at(scene::AtToward{false, number, end}), room).has_value());
    }
  }
}

TEST_CASE("corners can be reached exactly", "[place]") {
  for (const std::string& notation : notations()) {
    CAPTURE(notation);
    const room::Room room = make_room(notation);
    const int n = static_cast<int>(room.corners.size());
    for (int i = 0; i < n; ++i) {
      const Point p = locate(at(scene::AtWalls{{(i + n - 1) % n + 1, i + 1}, {0, 0}}), room).value();
      CHECK(geometry::contains(room.outline, p) == Containment::on_border);
      if (n > 2) CHECK(geometry::distance(room.space, p, room.corners[i].at) == 0);
      const double far = geometry::distance(room.space, Point{}, room.corners[i].at);
      if (far < 3) CHECK(locate(at(scene::AtToward{true, i + 1, far}), room).has_value());
      CHECK(!locate(at(scene::AtToward{true, i + 1, far + 1e-3}), room));
    }
  }
}

TEST_CASE("places that are none are refused by name", "[place]") {
  const room::Room room = make_room("*22222");
  const auto code = [&](const scene::Place& place) { return locate(place, room).error()[0].code; };
  CHECK(code(at(scene::AtDisk{{1, 0.1}})) == "place.outside-disk");
  CHECK(code(at(scene::AtDisk{{0.9, 0.1}})) == "place.outside-room");
  CHECK(code(at(scene::AtPolar{1e9, {}})) == "place.outside-room");
  CHECK(code(at(scene::AtPolar{std::nan(""), {}})) == "place.outside-room");
  CHECK(code(at(scene::AtToward{true, 6, 0.1})) == "place.no-such-corner");
  CHECK(code(at(scene::AtToward{false, 0, 0.1})) == "place.no-such-wall");
  CHECK(code(at(scene::AtWalls{{1, 7}, {0.1, 0.1}})) == "place.no-such-wall");
  CHECK(code(at(scene::AtWalls{{2, 2}, {0.1, 0.1}})) == "place.no-such-point");
  CHECK(code(at(scene::AtWalls{{1, 3}, {0.01, 0.01}})) == "place.no-such-point");
  scene::Place high;
  high.z = 1.5;
  CHECK(locate(high, room, 1.0, 0).error()[0].message.find("0.5 above the ceiling") != std::string::npos);
  high.z = -0.25;
  CHECK(locate(high, room, 1.0, 0).error()[0].message.find("0.25 under the floor") != std::string::npos);
  CHECK(locate({}, room, 1.0, 0.5).value().z == 0.5);
}
