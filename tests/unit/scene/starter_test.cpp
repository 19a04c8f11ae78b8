#include "compiler/scene/starter.h"

#include <catch2/catch.hpp>

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
    const std::string text = starter_scene(notation, walls, inradius);
    const auto read = read_scene(SourceText{"new.yaml", text});
    INFO(text);
    if (!read) FAIL(to_text(read.error()));
    CHECK(to_text(read->notes).empty());
    CHECK(static_cast<int>(read->scene.room.walls.size()) == walls);
    REQUIRE(read->scene.objects.size() == 2);
    const double r = inradius > 0 ? inradius : 0.5;
    for (const Object& object : read->scene.objects) CHECK(std::get<AtPolar>(object.place.floor).r < 0.75 * r);
    CHECK(std::get<AtPolar>(read->scene.camera.place.floor).r < 0.75 * r);
    CHECK(read->scene.lamps[0].place.z.value() < read->scene.room.height);
  }
}

TEST_CASE("what a starter scene offers in comments is right as well", "[scene]") {
  for (const auto& [notation, walls, inradius] : {std::tuple{"*22222", 5, 0.5}, {"*", 1, 1.5}, {"**", 4, 1.0}, {"*22∞", 4, 1.0}, {"*235", 3, 0.19}}) {
    const std::string text = starter_scene(notation, walls, inradius);
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

TEST_CASE("a starter scene quotes whatever its notation is", "[scene]") {
  const auto read = read_scene(SourceText{"new.yaml", starter_scene("*22\"\n: {\\", 2, 1)});
  REQUIRE_FALSE(read);
  for (const Diagnostic& diagnostic : read.error()) CHECK(diagnostic.code.substr(0, 9) == "notation.");
}
