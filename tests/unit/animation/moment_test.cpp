// A film is its scene with other values at each moment.
#include "compiler/animation/moment.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "compiler/animation/interpolate.h"
#include "compiler/animation/path.h"
#include "compiler/geometry/chart.h"
#include "compiler/notation/parse.h"
#include "compiler/place/locate.h"
#include "compiler/room/realise.h"
#include "compiler/scene/print_document.h"

using namespace orbc;

namespace {

scene::ReadResult read(const std::string& text, const scene::Overrides& overrides = {}) {
  auto result = scene::read_scene(SourceText{"film.yaml", text}, "", overrides);
  if (!result) FAIL(to_text(result.error()));
  return std::move(*result);
}

std::string film_of(const std::string& set, const std::string& orbifold = "*22222") {
  return "orbc: 1\norbifold: \"" + orbifold + "\"\ncamera: {at: {polar: [0.2, 0deg], z: 0.5}}\nanimation: {frames: 4, set: {" + set +
         "}}\n";
}

Result<scene::Overrides> overrides_at(const std::string& text, double t) {
  const auto film = read(text);
  REQUIRE(film.scene.animation);
  return animation::overrides_at(*film.scene.animation, t,
                                 [&](const scene::Overrides& more) { return scene::read_scene(SourceText{"film.yaml", text}, "", more); });
}

scene::Scene scene_at(const std::string& text, double t) {
  const auto overrides = overrides_at(text, t);
  if (!overrides) FAIL(to_text(overrides.error()));
  return read(text, *overrides).scene;
}

std::string code_at(const std::string& text, double t) {
  const auto overrides = overrides_at(text, t);
  REQUIRE_FALSE(overrides);
  return overrides.error().front().code;
}

room::Room room_of(const std::string& notation) {
  notation::ParseOptions options;
  options.allow_non_orbifold = true;
  return room::realise(notation::parse_with_notes(notation, options)->orbifold, {}, true).value();
}

}  // namespace

TEST_CASE("numbers, angles, colours, lists and maps run between keyframes", "[animation]") {
  const std::string text = film_of("camera.fov: {from: 60deg, to: 90deg}, exposure: {keys: [[0.25, 1], [0.75, 3]]}, "
                                   "camera.size: {keys: [[0, [100, 50]], [1, [200, 150]]]}, room.floor: {from: black, to: white}");
  const scene::Scene half = scene_at(text, 0.5), start = scene_at(text, 0), late = scene_at(text, 0.9);
  CHECK(half.camera.fov.radians == Approx(75 * 3.14159265358979 / 180));
  CHECK(half.exposure == Approx(2));
  CHECK(start.exposure == Approx(1));  // before the first keyframe
  CHECK(late.exposure == Approx(3));   // after the last
  CHECK(half.camera.size == std::array<int, 2>{150, 100});
  CHECK(half.room.floor.material.color.g == Approx(0.5));  // in linear light
  CHECK_FALSE(half.animation);
}

TEST_CASE("smooth keyframes are slow at both ends, steps wait for the next keyframe", "[animation]") {
  CHECK(scene_at(film_of("exposure: {from: 1, to: 2, interpolate: smooth}"), 0.25).exposure == Approx(1 + 0.15625));
  const std::string steps = film_of("camera.projection: {keys: [[0, perspective], [0.5, cylinder]], interpolate: step}");
  CHECK(scene_at(steps, 0.49).camera.projection == scene::Projection::perspective);
  CHECK(scene_at(steps, 0.5).camera.projection == scene::Projection::cylinder);
  CHECK(code_at(film_of("camera.projection: {from: perspective, to: cylinder}"), 0.5) == "animation.no-interpolation");
}

TEST_CASE("corners of the orbifold run through the flat room", "[animation]") {
  const std::string text = film_of("orbifold.corners.3: {from: 5, to: 7}", "*236");
  CHECK(scene_at(text, 0.5).orbifold.corners.at(2) == Rational(6));
  const scene::Scene between = scene_at(text, 0.75);
  CHECK(between.allow_non_orbifold);
  CHECK(static_cast<double>(between.orbifold.corners.at(2)) == Approx(6.5));
  CHECK(code_at(film_of("orbifold.corners.4: {from: 5, to: 7}", "*236"), 0.5) == "animation.no-such-corner");
  CHECK(code_at(film_of("orbifold.corners.3: {from: a, to: a}", "*236"), 0.5) == "animation.bad-corner");
}

TEST_CASE("a walk keeps its distance from the walls and its speed, and closes", "[animation]") {
  for (const char* notation : {"*222", "*236", "*22222", "*2323", "*(2.5)(2.5)(2.5)(2.5)(2.5)"}) {
    INFO(notation);
    const room::Room room = room_of(notation);
    scene::WallWalk walk;
    walk.distance = room.inradius * 0.3;
    walk.start = 2;
    const auto path = animation::wall_path(room, walk, {});
    REQUIRE(path);
    constexpr int kSteps = 4000;
    double shortest = 1e9, longest = 0;
    for (int i = 0; i < kSteps; ++i) {
      const geometry::Point here = animation::point_at(*path, path->length * i / kSteps).at;
      CHECK(-place::overhang(room, here).distance == Approx(walk.distance).epsilon(1e-9));
      const double step = geometry::distance(room.space, here, animation::point_at(*path, path->length * (i + 1) / kSteps).at);
      longest = std::fmax(longest, step);
      if (step < path->length / kSteps * 0.999) continue;  // round a corner
      shortest = std::fmin(shortest, step);
    }
    CHECK(longest <= path->length / kSteps * (1 + 1e-6));
    CHECK(shortest >= path->length / kSteps * 0.999);
    CHECK(geometry::distance(room.space, animation::point_at(*path, 0).at, animation::point_at(*path, path->length).at) < 1e-9);
    // It begins as far from both walls of its corner, and goes towards the next one.
    const auto from_wall = [&](std::size_t wall, double s) {
      return geometry::signed_distance(room.space, room.walls[wall].line, animation::point_at(*path, s).at);
    };
    CHECK(from_wall(0, 0) == Approx(walk.distance));
    CHECK(from_wall(1, 0) == Approx(walk.distance));
    CHECK(from_wall(1, path->length * 0.01) == Approx(walk.distance));
    CHECK(from_wall(0, path->length * 0.01) > walk.distance * 1.0001);
  }
}

TEST_CASE("a walk that the room is too narrow for is refused", "[animation]") {
  CHECK(code_at(film_of("camera.at: {walk: walls, distance: 0.7}"), 0) == "animation.no-walk");
  CHECK(code_at(film_of("camera.at: {walk: walls, distance: 0.1}", "*"), 0) == "animation.no-walk");
}

TEST_CASE("a curve goes through its places at constant speed, without a kink, and closes", "[animation]") {
  for (const char* notation : {"*222", "*333", "*22222"}) {
    INFO(notation);
    const room::Room room = room_of(notation);
    scene::PlacePath spline;
    for (const double degrees : {0.0, 100.0, 220.0}) {
      scene::Place place;
      place.floor = scene::AtPolar{room.inradius * 0.6, Angle::from_degrees(degrees)};
      place.z = degrees / 1000;
      spline.places.push_back(place);
    }
    const auto path = animation::place_path(room, spline);
    REQUIRE(path);
    for (const scene::Place& place : spline.places) {
      const geometry::Point goal = place::locate(place, room).value();
      double nearest = 1e9;
      for (int i = 0; i < 3000; ++i)
        nearest = std::fmin(nearest, geometry::distance(room.space, goal, animation::point_at(*path, path->length * i / 3000).at));
      CHECK(nearest < path->length / 3000);
    }
    constexpr int kSteps = 500;
    geometry::Point last = animation::point_at(*path, -path->length / kSteps).at;
    double turn = 0;
    for (int i = 0; i < kSteps; ++i) {
      const geometry::Point here = animation::point_at(*path, path->length * i / kSteps).at;
      const geometry::Point next = animation::point_at(*path, path->length * (i + 1) / kSteps).at;
      CHECK(geometry::distance(room.space, here, next) == Approx(path->length / kSteps).epsilon(0.01));
      const geometry::Isometry from = geometry::inverse(geometry::translation_to(room.space, here));
      const std::complex<double> in = geometry::log_from_point(room.space, from * last),
                                 out = geometry::log_from_point(room.space, from * next);
      turn = std::fmax(turn, std::fabs(std::arg(-out / in)));
      last = here;
    }
    CHECK(turn < 0.03);  // radians; a full turn in 500 steps is 0.013 on average
  }
}

TEST_CASE("what looks ahead looks along its walk, in the frame of its place", "[animation]") {
  const std::string text = film_of("camera.at: {walk: walls, distance: 0.2}, camera.look_at: {ahead: {lead: 0.001, elevation: -5deg}}");
  const scene::Scene early = scene_at(text, 0.1), later = scene_at(text, 0.1001);
  const room::Room room = room_of("*22222");
  const geometry::Point here = place::locate(early.camera.place, room).value(), there = place::locate(later.camera.place, room).value();
  const auto step = geometry::log_from_point(room.space, geometry::inverse(geometry::translation_to(room.space, here)) * there);
  const auto gaze = std::get<scene::LookDirection>(early.camera.look_at.value);
  CHECK(std::remainder(gaze.azimuth.radians - std::arg(step), 2 * 3.14159265358979) == Approx(0).margin(0.01));
  CHECK(gaze.elevation.radians == Approx(-5 * 3.14159265358979 / 180));
  const std::string back = film_of("camera.at: {walk: walls, distance: 0.2, laps: -1}, camera.look_at: {ahead: {lead: 0.001}}");
  const auto other = std::get<scene::LookDirection>(scene_at(back, 0.9).camera.look_at.value);
  CHECK(std::fabs(std::remainder(other.azimuth.radians - gaze.azimuth.radians, 2 * 3.14159265358979)) >
        3.1);  // the same place, the other way
  CHECK(code_at(film_of("camera.look_at: ahead"), 0) == "animation.nothing-ahead");
}

TEST_CASE("frames have noise of their own, unless it is locked", "[animation]") {
  for (const bool locked : {false, true}) {
    const std::string text =
        std::string("orbc: 1\norbifold: \"*22222\"\nintegrator: path\nbake: {seed: 7}\nlights: [{at: centre, power: 1}]\n") +
        "camera: {at: {polar: [0.2, 0deg], z: 0.5}}\nanimation: {frames: 4, set: {exposure: {from: 1, to: 2}}" +
        (locked ? ", seed: locked}\n" : "}\n");
    const auto film = read(text);
    const auto again = [&](const scene::Overrides& more) { return scene::read_scene(SourceText{"film.yaml", text}, "", more); };
    const auto frame = animation::overrides_of_frame(*film.scene.animation, 3, again);
    REQUIRE(frame);
    CHECK(read(text, *frame).scene.bake.seed == (locked ? 7 : 10));
    CHECK(read(text, *frame).scene.exposure == Approx(1.75));
  }
}

TEST_CASE("a document that is printed reads as the same scene", "[animation]") {
  const std::string text =
      "orbc: 1\norbifold: \"*22222\"\nroom: {height: 0.9, walls: {all: {mirror: {reflectance: 0.9}}, 1: {mirror: none, color: "
      "\"#a0b0c0\"}}}\n"
      "objects: [{name: \"a: \\\"b\\\" #c\", sphere: {radius: 0.1}, at: centre}, {box: {size: [0.1, 0.2, 0.3]}, at: {polar: [0.2, 30deg], "
      "z: 0.4}}]\n";
  const scene::SceneText source{std::make_shared<const SourceText>(SourceText{"s.yaml", text}), ""};
  const auto document = scene::document_of(source, {});
  REQUIRE(document);
  const std::string printed = scene::block_text(document->root);
  const auto again = scene::document_of({std::make_shared<const SourceText>(SourceText{"t.yaml", printed}), ""}, {});
  if (!again) FAIL(to_text(again.error()));
  CHECK(scene::flow_text(again->root) == scene::flow_text(document->root));
  CHECK(read(printed).scene.objects.front().name == "a: \"b\" #c");
}
