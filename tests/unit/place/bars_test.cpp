#include "compiler/place/bars.h"

#include <catch2/catch.hpp>

#include "compiler/place/locate.h"
#include "compiler/place/panels.h"
#include "rooms.h"

using namespace orbc;
using namespace orbc::place;
using namespace orbc::place::test;
using geometry::Point;
using geometry::Position;
using geometry::Space;

namespace {

// Volume by the divergence theorem does not hold in curved floors; signed floor area of what faces up against what faces down does.
double signed_floor_area(const room::Room& room, const PlacedMesh& mesh) {
  double sum = 0;
  for (const mesh::Triangle& t : mesh.triangles) sum += area(room.space, mesh.floor[t[0]], mesh.floor[t[1]], mesh.floor[t[2]]);
  return sum;
}

}  // namespace

TEST_CASE("a beam in the room is closed, at constant depth from its geodesic", "[place]") {
  for (const char* notation : {"*33", "*222", "*333", "*22222"}) {
    CAPTURE(notation);
    const room::Room room = make_room(notation);
    const Position a{geometry::point_from_log(room.space, {-0.2, 0.1}), 0.3}, b{geometry::point_from_log(room.space, {0.25, 0.05}), 0.5};
    const PlacedMesh beam = make_bar(room, 1.0, a, b, 0.04).value();
    CHECK(open_edges({beam}).empty());
    CHECK(std::fabs(signed_floor_area(room, beam)) < 1e-5);
    const geometry::Line line = geometry::line_through(room.space, a.floor, b.floor);
    for (std::size_t i = 0; i < beam.floor.size(); ++i)
      CHECK(std::fabs(geometry::signed_distance(room.space, line, beam.floor[i])) == Approx(0.02).epsilon(1e-9));
    // Its top faces up.
    double up = 0;
    for (const mesh::Triangle& t : beam.triangles) {
      const double one = area(room.space, beam.floor[t[0]], beam.floor[t[1]], beam.floor[t[2]]);
      if (one > 0) up += one;
    }
    CHECK(up > 0.04 * geometry::distance(room.space, a.floor, b.floor) * 0.9);
  }
}

TEST_CASE("an upright beam is a square column", "[place]") {
  const room::Room room = make_room("*22222");
  const Point p = geometry::point_from_log(room.space, {0.2, 0.1});
  const PlacedMesh column = make_bar(room, 1.0, {p, 0}, {p, 1}, 0.1).value();
  CHECK(open_edges({column}).empty());
  for (std::size_t i = 0; i < column.floor.size(); ++i)
    CHECK(geometry::distance(room.space, p, column.floor[i]) == Approx(0.05 * std::sqrt(2)).epsilon(2e-3));
  CHECK(make_bar(room, 1.0, {p, 0.5}, {p, 0.5}, 0.1).error()[0].code == "place.no-beam");
}

TEST_CASE("a beam from wall to wall is cut off at the walls", "[place]") {
  for (const char* notation : {"*333", "*22222", "*222"}) {
    const room::Room room = make_room(notation);
    const Position a{snap_into_room(room, room::point_on_wall(room, 0, 0.3 * room.walls[0].length)), 0.5},
        b{snap_into_room(room, room::point_on_wall(room, 1, 0.6 * room.walls[1].length)), 0.01};
    const PlacedMesh beam = make_bar(room, 1.0, a, b, 0.04).value();
    for (std::size_t i = 0; i < beam.floor.size(); ++i) {
      CHECK(overhang(room, beam.floor[i]).distance < 1e-12);
      CHECK(beam.z[i] >= -1e-15);
    }
    // What is open lies on a wall or on the floor.
    for (const auto& [p, q] : open_edges({beam})) {
      const Point x = geometry::midpoint(room.space, {p[0], p[1], p[2]}, {q[0], q[1], q[2]});
      CHECK((overhang(room, x).distance > -1e-9 || p[3] + q[3] < 1e-9));
    }
  }
}

TEST_CASE("frames stay in the room and are open only where they meet their mirror images", "[place]") {
  for (const std::string& notation : notations()) {
    CAPTURE(notation);
    const room::Room room = make_room(notation);
    std::vector<FrameSpec> specs;
    for (std::size_t i = 0; i < room.walls.size(); ++i) specs.push_back({static_cast<int>(i), {0, room.walls[i].length}, {0, 1}, 0.04});
    for (int half = 0; half < 2; ++half) {
      if (half == 1)
        for (FrameSpec& f : specs) f.span[0] = 0.3 * f.span[1], f.span[1] *= 0.7, f.height[0] = 0.2, f.height[1] = 0.7;
      const std::vector<PlacedMesh> frames = make_frames(room, 1.0, specs);
      REQUIRE(frames.size() == specs.size());
      for (std::size_t i = 0; i < frames.size(); ++i) {
        CAPTURE(i, half);
        REQUIRE(!frames[i].triangles.empty());
        CHECK(frames[i].wall == static_cast<int>(i));
        for (std::size_t v = 0; v < frames[i].floor.size(); ++v) {
          CHECK(overhang(room, frames[i].floor[v]).distance < 1e-11);
          CHECK((frames[i].z[v] >= 0 && frames[i].z[v] <= 1));
          CHECK(geometry::signed_distance(room.space, room.walls[i].line, frames[i].floor[v]) <=
                0.02 + 1.6e-4);  // chords bulge by width / 250
        }
      }
      // Joined at the mitres, nothing is open but on walls, floor and ceiling. Mitred cuts are made twice, so they agree to rounding only.
      for (const auto& [p, q] : open_edges(frames)) {
        const Point x = geometry::midpoint(room.space, {p[0], p[1], p[2]}, {q[0], q[1], q[2]});
        const double z = 0.5 * (p[3] + q[3]);
        bool on_mitre = false;
        for (std::size_t c = 0; c < room.corners.size(); ++c)
          on_mitre = on_mitre || std::fabs(geometry::value_at(bisector(room, static_cast<int>(c)), x)) < 1e-9;
        CHECK((overhang(room, x).distance > -1e-9 || z < 1e-9 || z > 1 - 1e-9 || on_mitre));
      }
    }
  }
}

TEST_CASE("the front of a frame has the area of its ring", "[place]") {
  const room::Room room = make_room("*2222");
  const double l = room.walls[0].length;
  const PlacedMesh frame = make_frames(room, 1.0, {{0, {0.3, l - 0.3}, {0.2, 0.8}, 0.1}})[0];
  double front = 0, flanks = 0;
  for (const mesh::Triangle& t : frame.triangles) {
    double d[3], s[3];
    for (int i = 0; i < 3; ++i) {
      d[i] = geometry::signed_distance(room.space, room.walls[0].line, frame.floor[t[i]]);
      s[i] = geometry::distance(room.space, room.walls[0].start, geometry::foot(room.space, room.walls[0].line, frame.floor[t[i]]));
    }
    const double twice = (s[2] - s[0]) * (frame.z[t[1]] - frame.z[t[0]]) - (s[1] - s[0]) * (frame.z[t[2]] - frame.z[t[0]]);
    if (d[0] > 0.049 && d[1] > 0.049 && d[2] > 0.049) front += twice / 2;
    else flanks += std::fabs(twice);
  }
  CHECK(front == Approx((l - 0.5) * 0.7 - (l - 0.7) * 0.5).epsilon(1e-9));
  CHECK(flanks < 1e-12);
}

TEST_CASE("frames mirrored in their wall close: what is open there lies in the mirror plane", "[place]") {
  const room::Room room = make_room("*22222");
  const PlacedMesh frame = make_frames(room, 1.0, {{1, {0.3, 0.7}, {0.2, 0.8}, 0.1}})[0];
  for (const auto& [p, q] : open_edges({frame}))
    for (const Key& k : {p, q}) CHECK(std::fabs(geometry::signed_distance(room.space, room.walls[1].line, {k[0], k[1], k[2]})) < 1e-12);
}
