#include "compiler/driver/tail.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/unit/bend/fixture.h"

using namespace orbc;
using namespace orbc::bend::test;

TEST_CASE("paths are cut off where copies have no bounce left, or not enough weight for one more", "[driver]") {
  const auto room = regular_room(5, 2);
  scene::CoverSpec spec;
  spec.max_bounces = 3;
  cover::Copy copy;
  copy.bounces = 2;
  copy.weight = {0.81, 0.81, 0.81};
  CHECK(driver::cut_mirrors(room, spec, copy) == std::vector<bool>(5, false));
  spec.min_weight = 0.75;
  CHECK(driver::cut_mirrors(room, spec, copy) == std::vector<bool>(5, true));
  spec.min_weight = 0.7;
  CHECK(driver::cut_mirrors(room, spec, copy) == std::vector<bool>(5, false));
  copy.bounces = 3;
  CHECK(driver::cut_mirrors(room, spec, copy) == std::vector<bool>(5, true));
}

TEST_CASE("storeys are cut off on the side away from the room", "[driver]") {
  auto room = regular_room(4, 2);
  room.mirrors.clear();
  room.mirrors.push_back({-2, {0, 0}, {0, 0}, 0.9, {1, 1, 1}});   // the ceiling
  room.mirrors.push_back({-1, {0, 0}, {0, 0}, 0.9, {1, 1, 1}});   // the floor
  scene::CoverSpec spec;
  spec.max_bounces = 1;
  cover::Copy copy;
  copy.bounces = 1;
  copy.storey = {1, -1, 2};   // above, on its head: its floor is up
  CHECK((driver::cut_mirrors(room, spec, copy) == std::vector<bool>{false, true}));
  copy.storey = {-1, -1, 0};
  CHECK((driver::cut_mirrors(room, spec, copy) == std::vector<bool>{true, false}));
  copy.storey = {};
  CHECK((driver::cut_mirrors(room, spec, copy) == std::vector<bool>{true, true}));
}

TEST_CASE("curtains cover their mirrors", "[driver]") {
  const auto room = regular_room(GENERATE(3, 4, 5), 2);
  const auto panels = driver::curtains(room, 3);
  REQUIRE(panels.size() == room.mirrors.size());
  for (std::size_t i = 0; i < panels.size(); ++i) {
    CHECK(panels[i].kind == place::PartKind::wall);
    CHECK(panels[i].wall == room.mirrors[i].wall);
    for (const auto& p : panels[i].floor) CHECK(std::fabs(geometry::value_at(room.room.walls[static_cast<std::size_t>(panels[i].wall)].line, p)) < 1e-12);
  }
}
