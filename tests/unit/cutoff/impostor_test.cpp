#include "compiler/cutoff/impostor.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "compiler/room/room.h"
#include "tests/unit/bend/fixture.h"

using namespace orbc;
using namespace orbc::bend::test;
using cutoff::Ending;
using Ends = std::vector<Ending>;

TEST_CASE("paths are cut off where copies have no bounce left, or not enough weight for one more", "[cutoff]") {
  const auto room = regular_room(5, 2);
  scene::CoverSpec spec;
  spec.max_bounces = 3;
  cover::Copy copy;
  copy.bounces = 2;
  copy.weight = {0.81, 0.81, 0.81};
  CHECK(cutoff::Endings(room, spec).of(copy) == Ends(5, Ending::none));
  spec.min_weight = 0.75;
  CHECK(cutoff::Endings(room, spec).of(copy) == Ends(5, Ending::depth));
  spec.min_weight = 0.7;
  CHECK(cutoff::Endings(room, spec).of(copy) == Ends(5, Ending::none));
  copy.bounces = 3;
  CHECK(cutoff::Endings(room, spec).of(copy) == Ends(5, Ending::depth));
}

TEST_CASE("storeys are cut off on the side away from the room", "[cutoff]") {
  auto room = regular_room(4, 2);
  room.mirrors.clear();
  room.mirrors.push_back({-2, {0, 0}, {0, 0}, {0.9, 0.9, 0.9}});  // the ceiling
  room.mirrors.push_back({-1, {0, 0}, {0, 0}, {0.9, 0.9, 0.9}});  // the floor
  scene::CoverSpec spec;
  spec.max_bounces = 1;
  cover::Copy copy;
  copy.bounces = 1;
  copy.storey = {1, -1, 2};  // above, on its head: its floor is up
  CHECK((cutoff::Endings(room, spec).of(copy) == Ends{Ending::none, Ending::depth}));
  copy.storey = {-1, -1, 0};
  CHECK((cutoff::Endings(room, spec).of(copy) == Ends{Ending::depth, Ending::none}));
  copy.storey = {};
  CHECK((cutoff::Endings(room, spec).of(copy) == Ends{Ending::depth, Ending::depth}));
}

TEST_CASE("a mirror ends where the copy behind it is left out, and only there", "[cutoff]") {
  const auto room = regular_room(5, 2);
  scene::CoverSpec spec;
  spec.max_bounces = 5;
  const geometry::Isometry behind_2 = room::reflection_in_wall(room.polygon, 2);
  const auto culled = [&](const cover::Copy& copy) {
    CHECK(copy.bounces == 1);
    return distance(room.polygon.space, copy.cover_from_room * geometry::Point(), behind_2 * geometry::Point()) < 1e-9;
  };
  cover::Copy copy;
  CHECK((cutoff::Endings(room, spec, culled).of(copy) == Ends{Ending::none, Ending::none, Ending::size, Ending::none, Ending::none}));
  // Not by the wall through which one came; and what the tracer does not reflect either is cut off by depth.
  copy.eye_facing_walls = 1 << 2;
  CHECK(cutoff::Endings(room, spec, culled).of(copy) == Ends(5, Ending::none));
  copy.eye_facing_walls = 0;
  spec.max_bounces = 0;
  CHECK(cutoff::Endings(room, spec, culled).of(copy) == Ends(5, Ending::depth));
}

TEST_CASE("copies that need the same panels share a model", "[cutoff]") {
  const auto room = regular_room(5, 2);
  scene::CoverSpec spec;
  spec.max_bounces = 1;
  std::vector<cover::Copy> copies(4);
  for (std::size_t i = 1; i < copies.size(); ++i) copies[i].bounces = 1;
  const auto panels = cutoff::impostor_panels(room, 3);
  std::vector<bend::Uv> uv;
  cutoff::Impostors impostors;
  for (const auto& panel : panels) uv.emplace_back(panel.floor.size());
  for (std::size_t i = 0; i < panels.size(); ++i) impostors.depth.push_back({&panels[i], &uv[i]});
  const auto made = cutoff::attach_impostors(cutoff::Endings(room, spec), copies, impostors, std::vector<bend::Model>(2), {0, 0, 0, 1});
  CHECK(made.attached == 15);
  CHECK((made.model_of_copy == std::vector<std::uint32_t>{0, 2, 2, 3}));
  CHECK(made.models[2].parts.size() == 5);
}

TEST_CASE("panels have a look for each band of heights, and no vertex within an edge", "[cutoff]") {
  auto room = regular_room(GENERATE(3, 4, 5), 2);
  room.mirrors[0].height[0] = 0.3 * room.height;  // begins within a band
  room.mirrors[1].height[1] = 0.2 * room.height;  // ends in the first
  const std::vector<double> bands{0.25 * room.height, 0.5 * room.height};
  const auto panels = cutoff::impostor_panels(room, 7, bands);
  const auto looks = [&](std::size_t i) { return std::set<int>(panels[i].style.begin(), panels[i].style.end()); };
  CHECK((looks(0) == std::set<int>{8, 9}));
  CHECK((looks(1) == std::set<int>{7}));
  CHECK((looks(2) == std::set<int>{7, 8, 9}));
  for (std::size_t t = 0; t < panels[2].triangles.size(); ++t)
    for (const std::uint32_t v : panels[2].triangles[t]) {
      const std::size_t band = panels[2].style[t] - 7U;
      CHECK(panels[2].z[v] >= (band == 0 ? -0.3 * room.height : bands[band - 1]));
      CHECK(panels[2].z[v] <= (band == 2 ? 1.3 * room.height : bands[band]));
    }
}

TEST_CASE("impostors cover their mirrors", "[cutoff]") {
  const auto room = regular_room(GENERATE(3, 4, 5), 2);
  const auto panels = cutoff::impostor_panels(room, 3);
  REQUIRE(panels.size() == room.mirrors.size());
  for (std::size_t i = 0; i < panels.size(); ++i) {
    CHECK(panels[i].kind == place::PartKind::wall);
    CHECK(panels[i].wall == room.mirrors[i].wall);
    for (const auto& p : panels[i].floor)
      CHECK(std::fabs(geometry::value_at(room.polygon.walls[static_cast<std::size_t>(panels[i].wall)].line, p)) < 1e-12);
  }
}
