// What is done to a mesh before it stands: up, scale, rotate.
#include <catch2/catch.hpp>

#include "compiler/mesh/analyse.h"
#include "compiler/mesh/primitives.h"
#include "compiler/place/embed.h"
#include "rooms.h"

using namespace orbc;
using namespace orbc::place;
using namespace orbc::place::test;
using geometry::Vector3;

namespace {

Angle degrees(double d) { return Angle::from_degrees(d); }

scene::Object plain_object() {
  scene::Object object;
  object.name = "thing";
  return object;
}

// In the plane: where a vertex stands.
Vector3 position(const PlacedMesh& placed, std::size_t i) { return {placed.floor[i].x, placed.floor[i].y, placed.z[i]}; }

mesh::Mesh flat_mesh(const PlacedMesh& placed) {
  mesh::Mesh mesh;
  for (std::size_t i = 0; i < placed.z.size(); ++i) mesh.positions.push_back(position(placed, i));
  mesh.triangles = placed.triangles;
  return mesh;
}

struct Box3 {
  Vector3 low, high;
};
Box3 extent(const PlacedMesh& placed) {
  const mesh::MeshReport e = mesh::analyse(flat_mesh(placed), {.crossings = false});
  return {e.lowest, e.highest};
}

// A lopsided body, whose centroid is not its middle: a box with a smaller one far out along +x, and one half as far along +y.
mesh::Mesh lopsided() {
  mesh::Mesh all;
  for (const auto& [size, at] : {std::pair<double, Vector3>{0.2, {0, 0, 0}}, {0.1, {0.3, 0, 0}}, {0.05, {0, 0.15, 0.1}}}) {
    const mesh::Mesh box = mesh::make_box({size, size, size}, {1, 1, 1});
    const auto first = static_cast<std::uint32_t>(all.positions.size());
    for (const Vector3& p : box.positions) all.positions.push_back(p + at);
    all.uv.insert(all.uv.end(), box.uv.begin(), box.uv.end());
    for (const mesh::Triangle& t : box.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return all;
}

}  // namespace

TEST_CASE("the axis that is up points up, whichever it is, and the mesh stays itself", "[place]") {
  const room::Room room = make_room("*2222");
  const mesh::Mesh body = lopsided();
  const mesh::MeshReport own = mesh::analyse(body);
  const double low[] = {own.lowest.x, own.lowest.y, own.lowest.z}, high[] = {own.highest.x, own.highest.y, own.highest.z};
  for (const scene::Axis up : {scene::Axis::plus_x, scene::Axis::minus_x, scene::Axis::plus_y, scene::Axis::minus_y, scene::Axis::plus_z,
                               scene::Axis::minus_z}) {
    const int number = static_cast<int>(up), axis = number / 2, sign = number % 2 == 0 ? 1 : -1;
    CAPTURE(number);
    scene::Object object = plain_object();
    object.up = up;
    const PlacedMesh placed = place_object(body, object, room, 2).value();
    const mesh::MeshReport now = mesh::analyse(flat_mesh(placed));
    CHECK(now.volume == Approx(own.volume));   // a turn, no mirror image
    const double foot = sign > 0 ? low[axis] : -high[axis];
    for (std::size_t i = 0; i < body.positions.size(); ++i) {
      const double at[] = {body.positions[i].x, body.positions[i].y, body.positions[i].z};
      CHECK(placed.z[i] == Approx(sign * at[axis] - foot).margin(1e-15));
    }
    CHECK(now.centroid.x == Approx(0).margin(1e-12));
    CHECK(now.centroid.y == Approx(0).margin(1e-12));
  }
}

TEST_CASE("rotate turns about x, then y, then z, each axis as it was, and the lowest point stands on the floor", "[place]") {
  const room::Room room = make_room("*2222");
  const mesh::Mesh box = mesh::make_box({0.4, 0.2, 0.1}, {1, 1, 1});
  scene::Object object = plain_object();
  object.rotate = {degrees(90), degrees(0), degrees(90)};
  const PlacedMesh placed = place_object(box, object, room, 1).value();
  for (std::size_t i = 0; i < box.positions.size(); ++i) {
    // About x: (x, −z, y); then about z: (z, x, y).
    const Vector3 &p = box.positions[i], at = position(placed, i);
    CHECK(at.x == Approx(p.z).margin(1e-15));
    CHECK(at.y == Approx(p.x).margin(1e-15));
    CHECK(at.z == p.y + 0.1);   // quarter turns are exact
  }
  // A general turn is the product of the three matrices.
  object.rotate = {degrees(20), degrees(-50), degrees(130)};
  const PlacedMesh tilted = place_object(box, object, room, 1).value();
  const double a = object.rotate[0].radians, b = object.rotate[1].radians, c = object.rotate[2].radians;
  double lowest = 0;
  std::vector<Vector3> expected;
  for (const Vector3& p : box.positions) {
    const Vector3 x{p.x, std::cos(a) * p.y - std::sin(a) * p.z, std::sin(a) * p.y + std::cos(a) * p.z};
    const Vector3 y{std::cos(b) * x.x + std::sin(b) * x.z, x.y, -std::sin(b) * x.x + std::cos(b) * x.z};
    expected.push_back({std::cos(c) * y.x - std::sin(c) * y.y, std::sin(c) * y.x + std::cos(c) * y.y, y.z});
    lowest = std::fmin(lowest, y.z);
  }
  for (std::size_t i = 0; i < expected.size(); ++i)
    CHECK(geometry::length(position(tilted, i) - expected[i] - Vector3{0, 0, -lowest}) < 1e-14);
  CHECK(*std::min_element(tilted.z.begin(), tilted.z.end()) == 0);
}

TEST_CASE("scale stretches before rotate, size holds for what comes of both, and turn comes last", "[place]") {
  const room::Room room = make_room("*2222");
  const mesh::Mesh box = mesh::make_box({0.1, 0.1, 0.1}, {2, 2, 2});
  scene::Object object = plain_object();
  object.scale = {1, 1, 4};
  object.rotate = {degrees(90), degrees(0), degrees(0)};
  Box3 e = extent(place_object(box, object, room, 1).value());
  CHECK(e.high.y - e.low.y == Approx(0.4));   // what was high lies along y now
  CHECK(e.high.z == Approx(0.1));
  object.size = 0.6;
  e = extent(place_object(box, object, room, 1).value());
  CHECK(e.high.y - e.low.y == Approx(0.6));
  CHECK(e.high.x - e.low.x == Approx(0.15));
  CHECK(e.high.z == Approx(0.15));
  object.turn = degrees(90);
  e = extent(place_object(box, object, room, 1).value());
  CHECK(e.high.x - e.low.x == Approx(0.6));
  CHECK(e.high.z == Approx(0.15));
}

TEST_CASE("a mirror image keeps its outside outside and its uv, in every space", "[place]") {
  const mesh::Mesh body = lopsided();
  for (const char* notation : {"*2222", "*222", "*22222"}) {
    CAPTURE(notation);
    const room::Room room = make_room(notation);
    scene::Object object = plain_object();
    const PlacedMesh whole = place_object(body, object, room, 2).value();
    object.scale = {-1, 1, 1};
    const PlacedMesh mirrored = place_object(body, object, room, 2).value();
    REQUIRE(mirrored.triangles.size() == whole.triangles.size());
    CHECK(open_edges({mirrored}).empty());
    for (std::size_t i = 0; i < body.positions.size(); ++i) {
      CHECK(mirrored.uv[i] == whole.uv[i]);
      CHECK(mirrored.floor[i].x == Approx(-whole.floor[i].x).margin(1e-14));
      CHECK(mirrored.floor[i].y == Approx(whole.floor[i].y).margin(1e-14));
    }
    // Volume in the chart (x, y) × height: its sign is that of the orientation.
    const double before = mesh::analyse(flat_mesh(whole)).volume, after = mesh::analyse(flat_mesh(mirrored)).volume;
    CHECK(before > 0);
    CHECK(after == Approx(before));
    // Two mirrors are a turn: nothing is turned over.
    object.scale = {-1, 1, -1};
    CHECK(mesh::analyse(flat_mesh(place_object(body, object, room, 2).value())).volume == Approx(before));
  }
}

TEST_CASE("an open mesh that is stretched unevenly is centred where it is then", "[place]") {
  // Two sheets: uneven factors move the centroid of their surface, but not by these factors.
  mesh::Mesh open;
  open.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {3, 0, 0}, {3, 0, 1}, {3, 1, 0}};
  open.triangles = {{0, 1, 2}, {3, 5, 4}};
  const room::Room room = make_room("*2222");
  scene::Object object = plain_object();
  object.scale = {0.1, 0.1, 0.4};
  const PlacedMesh placed = place_object(open, object, room, 1).value();
  const mesh::MeshReport e = mesh::analyse(flat_mesh(placed));
  CHECK(e.centroid.x == Approx(0).margin(1e-14));
  CHECK(e.centroid.y == Approx(0).margin(1e-14));
}

TEST_CASE("solid patterns turn with an object that is rotated", "[place]") {
  const room::Room room = make_room("*22222");
  const mesh::Mesh body = lopsided();
  scene::Object object = plain_object();
  object.rotate = {degrees(90), degrees(0), degrees(30)};
  const PlacedMesh placed = place_object(body, object, room, 2).value();
  // Up to where they begin, the coordinates of the pattern are the mesh's own.
  const Vector3 begin = placed.pattern_position[0] - body.positions[0];
  for (std::size_t i = 0; i < body.positions.size(); ++i)
    CHECK(geometry::length(placed.pattern_position[i] - body.positions[i] - begin) < 1e-14);
}
