#include "compiler/scene/starter.h"

#include <catch2/catch.hpp>
#include <complex>

#include "compiler/scene/read.h"

using namespace orbc;
using namespace orbc::scene;

TEST_CASE("the starter scene of every kind of room is read without a word", "[scene]") {
  const std::vector<std::tuple<std::string, int, double>> rooms = {{"*", 1, 1.57},
                                                                   {"*22", 2, 0.78},
                                                                   {"*(100)(100)", 2, 0.0157},
                                                                   {"*222", 3, 0.62},
                                                                   {"*235", 3, 0.19},
                                                                   {"*22(50)", 3, 0.03},
                                                                   {"*333", 3, 1},
                                                                   {"*2222", 4, 1},
                                                                   {"**", 4, 1},
                                                                   {"*22∞", 4, 1},
                                                                   {"*237", 3, 0.1},
                                                                   {"*2323", 4, 0.4},
                                                                   {"*22222", 5, 0.5},
                                                                   {"*23456789(10)(11)", 10, 2.1},
                                                                   {"*222", 3, 0},
                                                                   {"*(3/2)(12)(12)", 3, 0.3},
                                                                   {"*2 3 10", 3, 0.2}};
  for (const auto& [notation, walls, inradius] : rooms) {
    const std::string text = starter_scene({notation, walls, inradius, 300});
    const auto read = read_scene(SourceText{"new.yaml", text});
    INFO(text);
    if (!read) FAIL(to_text(read.error()));
    CHECK(to_text(read->notes).empty());
    CHECK(static_cast<int>(read->scene.room.walls.size()) == walls);
    REQUIRE(read->scene.objects.size() == 3);
    const double r = inradius > 0 ? inradius : 0.5;
    for (const Object& object : read->scene.objects) CHECK(std::get<AtPolar>(object.place.floor).r < 0.9 * r);
    CHECK(std::get<AtPolar>(read->scene.camera.place.floor).r < 0.9 * r);
    CHECK(read->scene.lamps[0].place.z.value() < read->scene.room.height);
  }
}

TEST_CASE("what a starter scene offers in comments is right as well", "[scene]") {
  for (const auto& [notation, walls, inradius] :
       {std::tuple{"*22222", 5, 0.5}, {"*", 1, 1.5}, {"**", 4, 1.0}, {"*22∞", 4, 1.0}, {"*235", 3, 0.19}}) {
    const std::string text = starter_scene({notation, walls, inradius, 0});
    int offers = 0;
    for (const char* offer : {"# 1: {mirror: none", "# 1: {mirrors"}) {
      std::string taken = text;
      const std::size_t at = taken.find(offer);
      REQUIRE(at != std::string::npos);
      taken.erase(at, 2);
      const auto read = read_scene(SourceText{"new.yaml", taken});
      INFO(taken);
      if (!read) FAIL(to_text(read.error()));
      CHECK(to_text(read->notes).empty());
      ++offers;
    }
    CHECK(offers == 2);
  }
}

TEST_CASE("the eye of a starter scene is as high as its objects, looks across the room, and nothing stands in its way", "[scene]") {
  for (const auto& [notation, inradius] : {std::pair{"*", 1.57}, {"**", 0.0}, {"*235", 0.13}, {"*333", 1.0}, {"*22222", 0.63},
                                           {"*23456789(10)(11)", 1.77}, {"*22(120)", 0.013}}) {
    const auto read = read_scene(SourceText{"new.yaml", starter_scene({notation, 4, inradius, 77})});
    if (!read) FAIL(to_text(read.error()));
    const double height = read->scene.room.height, eye_z = read->scene.camera.place.z.value();
    const auto& goal = std::get<Place>(read->scene.camera.look_at.value);
    const auto at = [](const Place& place) {
      const auto& polar = std::get<AtPolar>(place.floor);
      return std::polar(polar.r, polar.angle.radians);
    };
    const auto eye = at(read->scene.camera.place);
    const auto view = at(goal) - eye;
    INFO(notation);
    CHECK(std::abs(eye_z - goal.z.value()) < 0.15 * std::abs(view));   // at most 9 degrees up or down: half the picture is floor
    CHECK(eye_z > 0.35 * height);
    CHECK(eye_z < 0.6 * height);
    for (const Object& object : read->scene.objects) {
      const auto towards = (at(object.place) - eye) / view;  // along the view and to its left
      CHECK(towards.real() > 0.5);
      CHECK(std::abs(std::arg(towards)) > 0.12);  // beside the middle of the picture,
      CHECK(std::abs(std::arg(towards)) < 0.5);   // well within it
    }
  }
}

TEST_CASE("a starter scene quotes whatever its notation is", "[scene]") {
  const auto read = read_scene(SourceText{"new.yaml", starter_scene({"*22\"\n: {\\", 2, 1, 0})});
  REQUIRE_FALSE(read);
  for (const Diagnostic& diagnostic : read.error()) CHECK(diagnostic.code.substr(0, 9) == "notation.");
}
