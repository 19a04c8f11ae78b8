#include "compiler/place/camera.h"

#include <catch2/catch.hpp>

#include "compiler/mesh/primitives.h"
#include "compiler/place/furnish.h"
#include "compiler/mesh_io/load.h"
#include "compiler/place/locate.h"
#include "rooms.h"

using namespace orbc;
using namespace orbc::place;
using namespace orbc::place::test;
using geometry::Point;
using geometry::Vector3;

namespace {

scene::Scene bare_scene(const std::string& notation) {
  notation::ParseOptions any;
  any.allow_non_orbifold = true;
  scene::Scene scene = scene::default_scene(notation::parse(notation, any).value());
  scene.allow_non_orbifold = true;
  return scene;
}

Interior interior_of(const scene::Scene& scene) {
  return furnish(scene, room::realise(scene.orbifold, scene.room.shape, true).value(), mesh_io::assets_from_files()).value().interior;
}

scene::Object sphere_at(double r, double degrees, double z, double radius) {
  scene::Object object;
  object.name = "ball";
  object.shape = scene::SphereSpec{radius};
  object.place.floor = scene::AtPolar{r, Angle::from_degrees(degrees)};
  object.place.z = z;
  return object;
}

std::string code_of(const scene::Scene& scene, const Interior& room) {
  const auto eye = make_camera(scene, room);
  return eye ? "" : eye.error()[0].code;
}

double angle_between(const Vector3& a, const Vector3& b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

}  // namespace

TEST_CASE("a pixel's direction is seen in that pixel", "[place]") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const auto projection : {scene::Projection::perspective, scene::Projection::panorama, scene::Projection::cylinder})
    for (int trial = 0; trial < 200; ++trial) {
      scene::Scene scene = bare_scene("*22222");
      scene.camera.projection = projection;
      scene.camera.fov = Angle::from_degrees(20 + 140 * unit(random));
      scene.camera.size = {640, 400};
      scene.camera.look_at.value =
          scene::LookDirection{Angle::from_degrees(360 * unit(random)), Angle::from_degrees(180 * unit(random) - 90)};
      Interior room;
      room.polygon = make_room("*22222");
      const Camera eye = make_camera(scene, room).value();
      const double x = 640 * unit(random), y = 400 * unit(random);
      const Vector3 d = direction_through(eye, x, y);
      CHECK(length(d) == Approx(1).epsilon(1e-12));
      const auto pixel = pixel_of(eye, d);
      REQUIRE(pixel);
      CHECK((*pixel)[0] == Approx(x).margin(1e-8));
      CHECK((*pixel)[1] == Approx(y).margin(1e-8));
      // Right-handed and upright.
      CHECK(length(cross(eye.right, eye.up) + eye.forward) < 1e-12);
      CHECK(length(cross(eye.forward, eye.up) - eye.right) < 1e-12);
      CHECK(std::fabs(eye.right.z) < 1e-12);
      CHECK(eye.up.z > -1e-12);
      // One pixel at the centre.
      const double step = angle_between(direction_through(eye, 320, 200), direction_through(eye, 320.01, 200)) / 0.01;
      CHECK(step * pixels_per_radian(eye) == Approx(1).epsilon(1e-3));
    }
}

TEST_CASE("the camera looks along the geodesic to its target", "[place]") {
  std::mt19937 random(2);
  for (const std::string& notation : notations()) {
    CAPTURE(notation);
    Interior placed;
    placed.polygon = make_room(notation);
    for (int trial = 0; trial < 10; ++trial) {
      const Point from = random_point(placed.polygon, random), to = random_point(placed.polygon, random);
      if (geometry::distance(placed.polygon.space, from, to) > 3 || overhang(placed.polygon, from).distance > -1e-6) continue;
      scene::Scene scene = bare_scene(notation);
      scene.camera.place.floor = scene::AtDisk{geometry::disk_from_point(placed.polygon.space, from)};
      scene::Place target;
      target.floor = scene::AtDisk{geometry::disk_from_point(placed.polygon.space, to)};
      target.z = 0.9;
      scene.camera.look_at.value = target;
      const Camera eye = make_camera(scene, placed).value();
      CHECK(eye.z == 0.5);
      // Walk from the eye: the same slope, the point itself at the end.
      const double run = geometry::distance(placed.polygon.space, from, to), path = std::hypot(run, 0.4);
      CHECK(eye.forward.z * path == Approx(0.4).epsilon(1e-9));
      const Point reached =
          eye.room_from_eye * geometry::point_from_log(placed.polygon.space, {eye.forward.x * path, eye.forward.y * path});
      CHECK(geometry::distance(placed.polygon.space, reached, to) < 1e-9);
    }
  }
}

TEST_CASE("the camera looks at the middle of an object's bounding box", "[place]") {
  scene::Scene scene = bare_scene("*22222");
  scene.objects.push_back(sphere_at(0.3, 40, 0.2, 0.1));
  scene.camera.place.floor = scene::AtPolar{0.3, Angle::from_degrees(200)};
  scene.camera.look_at.value = scene::LookAtObject{"ball"};
  const Interior placed = interior_of(scene);
  const Camera eye = make_camera(scene, placed).value();
  const Point ball = locate(scene.objects[0].place, placed.polygon).value();
  const auto flat = geometry::log_from_point(placed.polygon.space, geometry::inverse(eye.room_from_eye) * ball);
  CHECK(angle_between(eye.forward, {flat.real(), flat.imag(), 0.3 - 0.5}) < 1e-3);
  scene.camera.look_at.value = scene::LookAtObject{"bell"};
  const auto unknown = make_camera(scene, placed);
  CHECK(unknown.error()[0].code == "place.no-such-object");
  CHECK(unknown.error()[0].hint.find("`ball`") != std::string::npos);
}

TEST_CASE("without a target the camera looks to the centre, or from there to the longest wall", "[place]") {
  scene::Scene scene = bare_scene("*2323");
  Interior placed;
  placed.polygon = make_room("*2323");
  scene.camera.look_at.value = scene::Place{};
  scene.camera.place.floor = scene::AtPolar{0.2, Angle::from_degrees(90)};
  CHECK(angle_between(make_camera(scene, placed).value().forward, {0, -1, 0}) < 1e-12);
  scene.camera.place = {};
  std::size_t longest = 0;
  for (std::size_t i = 1; i < 4; ++i)
    if (placed.polygon.walls[i].length > placed.polygon.walls[longest].length + 1e-9) longest = i;
  const Point middle = room::point_on_wall(placed.polygon, static_cast<int>(longest), placed.polygon.walls[longest].length / 2);
  CHECK(angle_between(make_camera(scene, placed).value().forward, {middle.x, middle.y, 0}) < 1e-9);
  // A place that the author wrote is meant.
  scene.camera.look_at.span.source = std::make_shared<SourceText>();
  CHECK(code_of(scene, placed) == "place.looks-at-itself");
}

TEST_CASE("straight up and straight down have an upper edge", "[place]") {
  scene::Scene scene = bare_scene("*333");
  Interior placed;
  placed.polygon = make_room("*333");
  for (const double azimuth : {0.0, 50.0})
    for (const double sign : {1.0, -1.0}) {
      scene.camera.look_at.value = scene::LookDirection{Angle::from_degrees(azimuth), Angle::from_degrees(90 * sign)};
      const Camera steep = make_camera(scene, placed).value();
      scene.camera.look_at.value = scene::LookDirection{Angle::from_degrees(azimuth), Angle::from_degrees(89.99999 * sign)};
      const Camera nearly = make_camera(scene, placed).value();
      CHECK(angle_between(steep.forward, {0, 0, sign}) == 0);
      CHECK(angle_between(steep.up, nearly.up) < 1e-5);
      CHECK(angle_between(steep.right, nearly.right) < 1e-5);
    }
  scene::Place below;
  below.z = 0;
  scene.camera.look_at.value = below;
  scene.camera.place.z = 0.4;
  CHECK(make_camera(scene, placed).value().forward.z == -1);
}

TEST_CASE("a camera that rolls clockwise turns its picture counter-clockwise about the middle", "[place]") {
  scene::Scene scene = bare_scene("*22222");
  scene.camera.place.floor = scene::AtPolar{0.2, Angle::from_degrees(30)};
  scene.camera.look_at.value = scene::LookDirection{Angle::from_degrees(120), Angle::from_degrees(-25)};
  scene.camera.size = {640, 400};
  Interior room;
  room.polygon = make_room("*22222");
  const Camera level = make_camera(scene, room).value();
  for (const double degrees : {30.0, -90.0, 180.0, 365.0}) {
    scene.camera.roll = Angle::from_degrees(degrees);
    const Camera rolled = make_camera(scene, room).value();
    CHECK(rolled.forward.x == level.forward.x);
    CHECK(geometry::length(geometry::cross(rolled.forward, rolled.up) - rolled.right) < 1e-14);
    const double a = scene.camera.roll.radians;
    for (const auto& [x, y] : {std::pair{400.0, 250.0}, {320.0, 100.0}}) {
      // In the picture y goes down, so counter-clockwise is (x, y) → (x·cos a + y·sin a, y·cos a − x·sin a).
      const auto seen = pixel_of(rolled, direction_through(level, x, y)).value();
      CHECK(seen[0] == Approx(320 + std::cos(a) * (x - 320) + std::sin(a) * (y - 200)));
      CHECK(seen[1] == Approx(200 + std::cos(a) * (y - 200) - std::sin(a) * (x - 320)));
    }
    scene.camera.projection = scene::Projection::panorama;
    CHECK(make_camera(scene, room).value().up.z == Approx(1));
    scene.camera.projection = scene::Projection::perspective;
  }
}

TEST_CASE("a lens is focused on a distance, an object or a place", "[place]") {
  for (const char* notation : {"*333", "*22222", "*222"}) {
    CAPTURE(notation);
    scene::Scene scene = bare_scene(notation);
    scene.objects.push_back(sphere_at(0.3, 40, 0.2, 0.1));
    scene.camera.place.floor = scene::AtPolar{0.3, Angle::from_degrees(200)};
    const Interior placed = interior_of(scene);
    CHECK_FALSE(make_camera(scene, placed).value().lens);
    scene.camera.lens.emplace();
    scene.camera.lens->radius = 0.02;
    scene.camera.lens->focus.value = 0.7;
    CHECK(make_camera(scene, placed).value().lens->focus_distance == 0.7);
    CHECK(make_camera(scene, placed).value().lens->radius == 0.02);
    const Point eye = locate(scene.camera.place, placed.polygon).value(), ball = locate(scene.objects[0].place, placed.polygon).value();
    scene.camera.lens->focus.value = scene::LookAtObject{"ball"};
    CHECK(
        make_camera(scene, placed).value().lens->focus_distance ==
        Approx(std::hypot(geometry::distance(placed.polygon.space, eye, ball), 0.2)).epsilon(1e-3));  // its middle is 0.3 high, the eye 0.5
    scene.camera.lens->focus.value = scene::Place{};
    CHECK(make_camera(scene, placed).value().lens->focus_distance == Approx(0.3));
    scene.camera.lens->focus.value = scene.camera.place;
    CHECK(code_of(scene, placed) == "place.lens-focus");
    scene.camera.lens->focus.value = scene::LookAtObject{"bell"};
    CHECK(code_of(scene, placed) == "place.no-such-object");
    scene.camera.lens->focus.value = 0.7;
    scene.camera.projection = scene::Projection::panorama;
    CHECK_FALSE(make_camera(scene, placed).value().lens);
  }
}

TEST_CASE("a lens that reaches into a wall, the floor or a body is refused", "[place]") {
  scene::Scene scene = bare_scene("*22222");
  scene.objects.push_back(sphere_at(0.2, 100, 0.3, 0.1));
  const Interior placed = interior_of(scene);
  scene.camera.lens.emplace();
  scene.camera.lens->focus.value = 0.5;
  scene.camera.look_at.value = scene::LookDirection{};
  const auto error_at = [&](double r, double degrees, double z, double radius) {
    scene.camera.place.floor = scene::AtPolar{r, Angle::from_degrees(degrees)};
    scene.camera.place.z = z;
    scene.camera.lens->radius = radius;
    const auto eye = make_camera(scene, placed);
    return eye ? "" : eye.error()[0].code + ": " + eye.error()[0].message;
  };
  CHECK(error_at(0, 0, 0.5, 0.05) == "");
  CHECK(error_at(0, 0, 0.5, 0.52).find("place.lens-too-large") == 0);
  CHECK(error_at(0, 0, 0.04, 0.05).find("the floor") != std::string::npos);
  CHECK(error_at(0, 0, 0.97, 0.05).find("the ceiling") != std::string::npos);
  const double to_wall = distance_to_boundary(placed.polygon, 0.7);
  CHECK(error_at(to_wall - 0.01, 0.7 * 180 / M_PI, 0.5, 0.05).find("wall ") != std::string::npos);
  // Beside the ball, within the lens's reach of it: along `up`, which is vertical here, the ball begins 0.02 below.
  CHECK(error_at(0.2, 100, 0.52, 0.05).find("ball") != std::string::npos);
}

TEST_CASE("an eye outside the room, in a wall or in a body is refused", "[place]") {
  for (const std::string notation : {"*333", "*22222", "*222"}) {
    CAPTURE(notation);
    scene::Scene scene = bare_scene(notation);
    scene.objects.push_back(sphere_at(0.2, 100, 0.3, 0.15));
    const Interior placed = interior_of(scene);
    const auto code_at = [&](double r, double degrees, double z) {
      scene.camera.place.floor = scene::AtPolar{r, Angle::from_degrees(degrees)};
      scene.camera.place.z = z;
      return code_of(scene, placed);
    };
    CHECK(code_at(3, 0, 0.5) == "place.eye-outside-room");
    CHECK(code_at(0.1, 0, 1.5) == "place.eye-outside-room");
    CHECK(code_at(0.1, 0, 1) == "place.eye-outside-room");
    CHECK(code_at(0.1, 0, 0) == "place.eye-outside-room");
    CHECK(code_at(0.1, 200, 0.5) == "");
    // The ball stands at height 0.3: its middle is at 0.45.
    CHECK(code_at(0.2, 100, 0.45) == "place.eye-inside-object");
    CHECK(code_at(0.25, 110, 0.45) == "place.eye-inside-object");
    CHECK(code_at(0.2, 100, 0.29) == "");
    CHECK(code_at(0.2, 100, 0.61) == "");
    CHECK(code_at(0.36, 100, 0.45) == "");
    const auto inside = make_camera((code_at(0.2, 100, 0.45), scene), placed);
    CHECK(inside.error()[0].message.find("ball") != std::string::npos);
    scene.camera.place.floor = scene::AtWalls{{1, 2}, {0, 0}};
    CHECK(code_of(scene, placed) == "place.eye-in-wall");
  }
}

TEST_CASE("an eye in a column from floor to ceiling is inside it", "[place]") {
  scene::Scene scene = bare_scene("*22222");
  scene::Object column;
  column.name = "column";
  scene::BarSpec beam;
  beam.from.floor = beam.to.floor = scene::AtPolar{0.3, Angle::from_degrees(60)};
  beam.to.z = 1, beam.width = 0.1;
  column.shape = beam;
  scene.objects = {column};
  const Interior placed = interior_of(scene);
  scene.camera.place.floor = scene::AtPolar{0.31, Angle::from_degrees(60)};
  CHECK(code_of(scene, placed) == "place.eye-inside-object");
  scene.camera.place.floor = scene::AtPolar{0.4, Angle::from_degrees(60)};
  CHECK(code_of(scene, placed) == "");
}

TEST_CASE("an eye next to a wall stands between the bars of its frame, not in it", "[place]") {
  for (const std::string notation : {"*333", "*22222", "*222"}) {
    CAPTURE(notation);
    scene::Scene scene = bare_scene(notation);
    for (scene::Wall& wall : scene.room.walls) wall.mirrors[0].frame.emplace().width = 0.1;
    const Interior placed = interior_of(scene);
    const auto code_at = [&](double from_wall, double z) {
      scene.camera.place.floor = scene::AtToward{false, 1, placed.polygon.inradius - from_wall};
      scene.camera.place.z = z;
      return code_of(scene, placed);
    };
    for (const double from_wall : {1e-5, 1e-3, 0.02}) CHECK(code_at(from_wall, 0.5) == "");
    CHECK(code_at(0.01, 0.97) == "place.eye-inside-object");   // in the bar at the ceiling
    CHECK(code_at(0.01, 0.03) == "place.eye-inside-object");
    CHECK(code_at(0.3, 0.97) == "");
  }
}

TEST_CASE("the eye in the hole of a ring is not inside it, wherever the vertical line meets edges and vertices", "[place][long]") {
  scene::Scene scene = bare_scene("*2222");
  scene::Object ring;
  ring.name = "ring";
  ring.shape = scene::TorusSpec{0.2, 0.08};
  ring.place.z = 0.4;
  scene.objects.push_back(ring);
  const Interior placed = interior_of(scene);
  const PlacedMesh& mesh = placed.parts.back();
  int inside = 0;
  // Straight under and over vertices and the middles of edges: parity must hold there too.
  for (std::size_t i = 0; i < mesh.floor.size(); i += 7) {
    const Point &p = mesh.floor[i], &q = mesh.floor[mesh.triangles[i][0]];
    for (const Point& x : {p, geometry::midpoint(placed.polygon.space, p, q)})
      for (const double z : {0.2, 0.48, 0.8}) {
        scene.camera.place.floor = scene::AtDisk{{x.x, x.y}};
        scene.camera.place.z = z;
        const double r = std::hypot(x.x, x.y), tube = std::hypot(r - 0.2, z - 0.48);
        if (std::fabs(tube - 0.08) < 3e-3) continue;
        CHECK(code_of(scene, placed) == (tube < 0.08 ? "place.eye-inside-object" : ""));
        inside += tube < 0.08;
      }
  }
  CHECK(inside > 50);
}

TEST_CASE("two eyes are 64 mm apart in a room of 2.5 m, unless the author says otherwise", "[place]") {
  for (const char* notation : {"*333", "*22222", "*222"}) {
    scene::Scene scene = bare_scene(notation);
    scene.camera.projection = scene::Projection::stereo;
    const Interior placed = interior_of(scene);
    CHECK(make_camera(scene, placed).value().eye_separation == Approx(0.0256 * placed.height));
    scene.camera.eye_separation = 0.05;
    CHECK(make_camera(scene, placed).value().eye_separation == 0.05);
    scene.camera.projection = scene::Projection::panorama;
    CHECK(make_camera(scene, placed).value().eye_separation == 0);
  }
}

TEST_CASE("a stereo panorama is refused where one of its eyes would stand in a wall or a body", "[place]") {
  scene::Scene scene = bare_scene("*22222");
  scene.objects.push_back(sphere_at(0.2, 100, 0.3, 0.1));
  const Interior placed = interior_of(scene);
  scene.camera.look_at.value = scene::LookDirection{};
  scene.camera.projection = scene::Projection::stereo;
  const auto error_at = [&](double r, double degrees, double z, double separation) {
    scene.camera.place.floor = scene::AtPolar{r, Angle::from_degrees(degrees)};
    scene.camera.place.z = z;
    scene.camera.eye_separation = separation;
    const auto eye = make_camera(scene, placed);
    return eye ? "" : eye.error()[0].code + ": " + eye.error()[0].message;
  };
  CHECK(error_at(0, 0, 0.5, 0.05) == "");
  const double to_wall = distance_to_boundary(placed.polygon, 0.7);
  CHECK(error_at(to_wall - 0.01, 0.7 * 180 / M_PI, 0.5, 0.03).find("place.stereo-eye") == 0);
  CHECK(error_at(to_wall - 0.01, 0.7 * 180 / M_PI, 0.5, 0.03).find("wall ") != std::string::npos);
  CHECK(error_at(to_wall - 0.01, 0.7 * 180 / M_PI, 0.5, 0.01) == "");
  // The ball is 0.1 wide at the height of its middle, 0.4, and begins 0.05 from an eye that stands 0.15 from its middle.
  CHECK(error_at(0.35, 100, 0.4, 0.12).find("ball") != std::string::npos);
  CHECK(error_at(0.35, 100, 0.4, 0.08) == "");
  CHECK(error_at(0.35, 100, 0.7, 0.12) == "");  // above the ball
}
