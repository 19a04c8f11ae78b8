#include <catch2/catch.hpp>

#include "compiler/geometry/predicates.h"
#include "compiler/mesh/primitives.h"
#include "compiler/place/locate.h"
#include "compiler/place/embed.h"
#include "rooms.h"

using namespace orbc;
using namespace orbc::place;
using namespace orbc::place::test;
using geometry::Point;
using geometry::Space;
using geometry::Vector3;

namespace {

scene::Object object_at(const Point& p, Space space, scene::Embedding embedding) {
  scene::Object object;
  object.name = "thing";
  object.embedding = embedding;
  object.place.floor = scene::AtDisk{geometry::disk_from_point(space, p)};
  return object;
}

// A place with some air around it, never the centre itself.
Point roomy_place(const room::Room& room, std::mt19937& random, double air) {
  for (;;) {
    const Point p = random_point(room, random);
    if (overhang(room, p).distance < -air) return p;
  }
}

const std::vector<std::string> kRooms = {"*", "*33", "*222", "*333", "*2222", "*22222", "*2323"};

}  // namespace

TEST_CASE("an exponential sphere has its points at true distances from the axis", "[place]") {
  std::mt19937 random(5);
  for (const std::string& notation : kRooms) {
    CAPTURE(notation);
    const room::Room room = make_room(notation);
    const mesh::Mesh sphere = mesh::make_sphere(0.2);
    scene::Object object = object_at(roomy_place(room, random, 0.21), room.space, scene::Embedding::exponential);
    object.turn = Angle::from_degrees(33);
    EmbedOptions coarse;
    coarse.tolerance = 1;
    const PlacedMesh placed = place_object(sphere, object, room, 1.0, coarse).value();
    const Point axis = locate(object.place, room).value();
    REQUIRE(placed.floor.size() == sphere.positions.size());
    for (std::size_t i = 0; i < placed.floor.size(); ++i) {
      const Vector3& p = sphere.positions[i];
      CHECK(geometry::distance(room.space, axis, placed.floor[i]) == Approx(std::hypot(p.x, p.y)).margin(1e-12));
      CHECK(placed.z[i] == Approx(p.z + 0.2).margin(1e-15));
      CHECK(placed.z[i] >= 0);
    }
  }
}

TEST_CASE("a conformal mesh keeps angles everywhere and lengths on the axis", "[place]") {
  std::mt19937 random(6);
  const double h = 1e-4;
  for (const std::string& notation : kRooms) {
    CAPTURE(notation);
    const room::Room room = make_room(notation);
    // Small crosses: on the axis, and off it.
    mesh::Mesh crosses;
    for (const double x : {-0.15, 0.0, 0.15}) {
      const auto first = static_cast<std::uint32_t>(crosses.positions.size());
      for (const auto& d : {Vector3{0, 0, 0}, Vector3{h, 0, 0}, Vector3{0, h, 0}, Vector3{-h, 0, 0}, Vector3{0, -h, 0}})
        crosses.positions.push_back(Vector3{x, 0, 0} + d);
      for (std::uint32_t i = 1; i <= 4; ++i) crosses.triangles.push_back({first, first + i, first + i % 4 + 1});
    }
    scene::Object object = object_at(roomy_place(room, random, 0.17), room.space, scene::Embedding::conformal);
    object.turn = Angle::from_degrees(70);
    const PlacedMesh placed = place_object(crosses, object, room, 1.0).value();
    for (std::size_t cross = 0; cross < 3; ++cross) {
      const Point& middle = placed.floor[5 * cross];
      double lengths[4], scale = 1;
      for (int i = 0; i < 4; ++i) lengths[i] = geometry::distance(room.space, middle, placed.floor[5 * cross + 1 + i]);
      // Metric of the disk: 2/(1 + κ|z|²) with z = x/2.
      scale = cross == 1 ? 1 : 1 / (1 + geometry::curvature(room.space) * 0.075 * 0.075);
      for (const double l : lengths) CHECK(l == Approx(scale * h).epsilon(1e-4));
      const double diagonal = geometry::distance(room.space, placed.floor[5 * cross + 1], placed.floor[5 * cross + 2]);
      CHECK(diagonal * diagonal == Approx(lengths[0] * lengths[0] + lengths[1] * lengths[1]).epsilon(1e-3));
    }
  }
}

TEST_CASE("size is the intrinsic length of the longer horizontal extent", "[place]") {
  for (const std::string& notation : kRooms) {
    CAPTURE(notation);
    const room::Room room = make_room(notation);
    for (const auto embedding : {scene::Embedding::conformal, scene::Embedding::exponential})
      for (const double size : {0.05, 0.4, 0.7}) {
        CAPTURE(size);
        // A bar along x, heavier at one end, so that its centroid is off its middle.
        mesh::Mesh bar;
        bar.positions = {{0, 0, 0}, {10, 0, 0}, {0, 0, 5}, {0, 0.1, 0}};
        bar.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
        scene::Object object = object_at({}, room.space, embedding);
        object.size = size;
        EmbedOptions coarse;
        coarse.tolerance = 1;
        const PlacedMesh placed = place_object(bar, object, room, 2.0, coarse).value();
        // y differs a little between the ends.
        CHECK(geometry::distance(room.space, placed.floor[0], placed.floor[1]) == Approx(size).epsilon(1e-3));
        const double factor = scale_for_size(room.space, embedding, -2.5, 7.5, size);
        CHECK(placed.z[2] == Approx(5 * factor).epsilon(1e-12));
      }
  }
  for (const Space space : {Space::spherical, Space::hyperbolic})
    for (const double low : {-0.3, -1.0, -5.0}) {
      const double f = scale_for_size(space, scene::Embedding::conformal, low, 2, 0.9);
      CHECK(2 * geometry::atan_k(space, f * 2 / 2) - 2 * geometry::atan_k(space, f * low / 2) == Approx(0.9).epsilon(1e-12));
    }
}

TEST_CASE("in the plane an object is simply moved, turned and scaled", "[place]") {
  const room::Room room = make_room("*2222");
  const mesh::Mesh box = mesh::make_box({0.4, 0.2, 0.3}, {1, 1, 1});
  scene::Object object = object_at({1, 0.3, -0.2}, room.space, scene::Embedding::conformal);
  object.size = 0.8;
  object.turn = Angle::from_degrees(90);
  object.place.z = 0.1;
  const PlacedMesh placed = place_object(box, object, room, 1.0).value();
  REQUIRE(placed.triangles == box.triangles);
  for (std::size_t i = 0; i < box.positions.size(); ++i) {
    const Vector3& p = box.positions[i];
    CHECK(placed.floor[i].x == Approx(0.3 - 2 * p.y));
    CHECK(placed.floor[i].y == Approx(-0.2 + 2 * p.x));
    CHECK(placed.z[i] == Approx(0.1 + 2 * (p.z + 0.15)).margin(1e-15));
    CHECK(placed.pattern_position[i].x == Approx(2 * p.x));
  }
}

TEST_CASE("y-up meshes stand up", "[place]") {
  const room::Room room = make_room("*2222");
  mesh::Mesh box = mesh::make_box({0.2, 0.6, 0.1}, {1, 1, 1});
  scene::Object object = object_at({}, room.space, scene::Embedding::conformal);
  object.up = scene::Axis::plus_y;
  const PlacedMesh placed = place_object(box, object, room, 1.0).value();
  CHECK(*std::max_element(placed.z.begin(), placed.z.end()) == Approx(0.6));
  // Turned about x: what pointed to +z points to −y.
  for (std::size_t i = 0; i < box.positions.size(); ++i) CHECK(placed.floor[i].y == Approx(-box.positions[i].z).margin(1e-15));
}

TEST_CASE("coarse meshes are refined until geodesic triangles follow the embedded ones", "[place]") {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(0, 1);
  const mesh::Mesh box = mesh::make_box({1, 0.8, 0.5}, {1, 1, 1});
  for (const char* notation : {"*", "*33", "*22222", "*2323"})
    for (const auto embedding : {scene::Embedding::conformal, scene::Embedding::exponential}) {
      CAPTURE(notation, embedding);
      const room::Room room = make_room(notation);
      scene::Object object = object_at({}, room.space, embedding);
      object.size = 0.5;
      EmbedOptions options;
      options.tolerance = 1e-4;
      const PlacedMesh placed = place_object(box, object, room, 1.0, options).value();
      CHECK(placed.triangles.size() > 12);
      CHECK(open_edges({placed}).empty());
      double worst = 0;
      for (const mesh::Triangle& t : placed.triangles) {
        const double a = unit(random), c = unit(random) * (1 - a), b[3] = {a, c, 1 - a - c};
        geometry::Ambient x{0, 0, 0};
        Vector3 flat;
        for (int k = 0; k < 3; ++k) x = x + b[k] * placed.floor[t[k]], flat = flat + b[k] * placed.pattern_position[t[k]];
        const std::complex<double> p(flat.x, flat.y);
        const Point truth = embedding == scene::Embedding::conformal ? geometry::point_from_disk(room.space, p / 2.0)
                                                                     : geometry::point_from_log(room.space, p);
        worst = std::fmax(worst, geometry::distance(room.space, truth, geometry::normalised_point(room.space, x)));
      }
      CHECK(worst < 1.5e-4);
      CHECK(worst > 1e-6);
    }
}

TEST_CASE("an object may touch walls, floor and ceiling, but not reach beyond", "[place]") {
  for (const std::string& notation : kRooms) {
    if (notation == "*") continue;
    CAPTURE(notation);
    const room::Room room = make_room(notation);
    // 0.1 away from the point of wall 1 that is nearest to the centre.
    const Point nearest = geometry::foot(room.space, room.walls[0].line, {});
    const Point p = geometry::point_from_log(
        room.space, std::polar(geometry::distance(room.space, {}, nearest) - 0.1, std::atan2(nearest.y, nearest.x)));
    mesh::Mesh cylinder = mesh::make_cylinder(0.1, 1.0, 256, 1, 1);
    scene::Object object = object_at(p, room.space, scene::Embedding::exponential);
    object.name = "column";
    for (Vector3& v : cylinder.positions) v.x *= 0.99, v.y *= 0.99;
    CHECK(place_object(cylinder, object, room, 1.0).has_value());
    for (Vector3& v : cylinder.positions) v.x /= 0.9, v.y /= 0.9;
    const auto beyond = place_object(cylinder, object, room, 1.0);
    REQUIRE(!beyond);
    CHECK(beyond.error()[0].code == "place.object-outside-room");
    REQUIRE(beyond.error()[0].message.substr(0, 15) == "column reaches ");
    CHECK(std::stod(beyond.error()[0].message.substr(15)) == Approx(0.01).epsilon(0.01));
    CHECK(beyond.error()[0].message.find("beyond wall 1") != std::string::npos);
  }
}

TEST_CASE("an object may stand with its vertices in the corners of the room and its top at the ceiling", "[place]") {
  for (const char* notation : {"*333", "*2222", "*22222", "*237", "*222"}) {
    CAPTURE(notation);
    const room::Room room = make_room(notation);
    mesh::Mesh prism;
    // Up to rounding the room itself, centred by its own centroid: only rooms with a symmetric one come out right.
    for (const double z : {0.0, 0.7})
      for (const room::Corner& corner : room.corners) {
        const auto p = geometry::log_from_point(room.space, corner.at);
        prism.positions.push_back({p.real(), p.imag(), z});
      }
    const auto n = static_cast<std::uint32_t>(room.corners.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t j = (i + 1) % n;
      prism.triangles.push_back({i, j, n + j}), prism.triangles.push_back({i, n + j, n + i});
      if (i > 0 && j > 0) prism.triangles.push_back({0, j, i}), prism.triangles.push_back({n, n + i, n + j});
    }
    scene::Object object = object_at({}, room.space, scene::Embedding::exponential);
    EmbedOptions coarse;
    coarse.tolerance = 10;
    const bool symmetric = std::string(notation) != "*237";
    CHECK(place_object(prism, object, room, 0.7, coarse).has_value() == symmetric);
    CHECK(!place_object(prism, object, room, 0.699, coarse));
  }
}

TEST_CASE("the hint of an object that reaches out names a size that fits", "[place]") {
  const room::Room room = make_room("*22222");
  const mesh::Mesh sphere = mesh::make_sphere(1);
  scene::Object object = object_at({}, room.space, scene::Embedding::conformal);
  object.size = 1.4;
  object.place.floor = scene::AtPolar{0.3, Angle::from_degrees(20)};
  const auto refused = place_object(sphere, object, room, 5.0);
  REQUIRE(!refused);
  const std::string hint = refused.error()[0].hint;
  REQUIRE(hint.substr(0, 7) == "`size: ");
  object.size = std::stod(hint.substr(7));
  CHECK(*object.size > 0.3);
  CHECK(place_object(sphere, object, room, 5.0).has_value());
  object.size = *object.size * 1.02;
  CHECK(!place_object(sphere, object, room, 5.0));
  object.size = 0.4;
  const auto low = place_object(sphere, object, room, 0.3);
  REQUIRE(!low);
  CHECK(low.error()[0].message.find("above the ceiling") != std::string::npos);
}

TEST_CASE("objects that no embedding can hold are refused", "[place]") {
  const room::Room room = make_room("*22222");
  scene::Object object = object_at({}, room.space, scene::Embedding::conformal);
  CHECK(place_object(mesh::make_sphere(3), object, room, 9.0).error()[0].code == "place.too-large");
  mesh::Mesh line;
  line.positions = {{0, 0, 0}, {0, 0, 1}, {0, 0, 2}};
  line.triangles = {{0, 1, 2}};
  object.size = 0.3;
  CHECK(place_object(line, object, room, 9.0).error()[0].code == "place.flat-object");
  object.size = 3.2;
  CHECK(place_object(mesh::make_sphere(1), object, make_room("*"), 9.0).error()[0].code == "place.too-large");
}

TEST_CASE("placing commutes with the room's symmetry", "[place]") {
  // *22222: turning place and object by 72° turns the placed mesh.
  const room::Room room = make_room("*22222");
  const mesh::Mesh torus = mesh::make_torus(0.1, 0.03);
  scene::Object object;
  object.place.floor = scene::AtPolar{0.3, Angle::from_degrees(10)};
  object.turn = Angle::from_degrees(5);
  const PlacedMesh first = place_object(torus, object, room, 1.0).value();
  object.place.floor = scene::AtPolar{0.3, Angle::from_degrees(82)};
  object.turn = Angle::from_degrees(77);
  const PlacedMesh second = place_object(torus, object, room, 1.0).value();
  REQUIRE(first.floor.size() == second.floor.size());
  const geometry::Isometry turn = geometry::rotation(room.space, 2 * M_PI / 5);
  for (std::size_t i = 0; i < first.floor.size(); ++i)
    CHECK(geometry::distance(room.space, turn * first.floor[i], second.floor[i]) < 1e-14);
}
