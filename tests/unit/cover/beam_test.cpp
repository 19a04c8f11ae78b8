#include "compiler/cover/beam.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "compiler/cover/storeys.h"
#include "compiler/cover/unfold.h"
#include "tests/support/mirror_room.h"

using namespace orbc;
using geometry::Space;

namespace {

using test::mirror_room;

place::Camera eye_in(const place::Interior& room) {
  place::Camera eye;
  eye.room_from_eye = geometry::translation_by(room.polygon.space, 0.05, 0.03);
  eye.z = 0.5;
  return eye;
}

std::vector<cover::Copy> beams_of(const place::Interior& room, const scene::CoverSpec& spec) {
  const auto copies = cover::unfold_by_beams(room, eye_in(room), spec);
  if (!copies) FAIL(to_text(copies.error()));
  return *copies;
}

/// The angle from a wedge's first border to its second.
double angle(const cover::Wedge& w) { return std::atan2(cover::cross(w.from, w.to), w.from.x * w.to.x + w.from.y * w.to.y); }

}  // namespace

TEST_CASE("beams of a room of equal mirrors find the copies of the group, whole", "[cover]") {
  const auto room =
      mirror_room(GENERATE("*22222", "*2323", "*237", "*333", "*244", "*2222", "*222", "*235", "*33", "*22", "*", "**", "*22∞"));
  for (const int bounces : {0, 1, 5, 11}) {
    const scene::CoverSpec spec{bounces, 0, 0, {}};
    const auto by_beams = beams_of(room, spec);
    const auto by_group = cover::unfold(room, eye_in(room), spec);
    REQUIRE(by_group);
    REQUIRE(by_beams.size() == by_group->size());
    for (std::size_t i = 0; i < by_beams.size(); ++i) {
      const auto &a = by_beams[i], &b = (*by_group)[i];
      CHECK(a.word == b.word);
      CHECK(a.sheet == b.sheet);
      CHECK(a.bounces == b.bounces);
      CHECK(a.eye_facing_walls == b.eye_facing_walls);
      CHECK(!a.wedge);
      CHECK(a.weight.r == Approx(b.weight.r).epsilon(1e-13));
      CHECK(geometry::difference(a.cover_from_room, b.cover_from_room) <= 1e-12);
    }
  }
}

TEST_CASE("a copy of a room with odd corners and unequal mirrors is cut where its paths differ in weight", "[cover]") {
  auto room = mirror_room("*333");
  room.mirrors[0].throughput = {0.5, 0.5, 0.5};
  room.mirrors[1].throughput = {0.7, 0.7, 0.7};
  const auto copies = beams_of(room, {3, 0, 0, {}});
  // s1 s2 s1 = s2 s1 s2: the copy opposite a corner is seen past it on both sides.
  std::map<std::string, std::vector<cover::Copy>> by_word;
  for (const auto& copy : copies) by_word[cover::to_string(copy.word)].push_back(copy);
  const auto& across = by_word.at("1 2 1");
  REQUIRE(across.size() == 2);
  CHECK(std::min(across[0].weight.r, across[1].weight.r) == Approx(0.5 * 0.5 * 0.7));
  CHECK(std::max(across[0].weight.r, across[1].weight.r) == Approx(0.5 * 0.7 * 0.7));
  REQUIRE(across[0].wedge);
  REQUIRE(across[1].wedge);
  const bool meets = across[0].wedge->to == across[1].wedge->from || across[1].wedge->to == across[0].wedge->from;
  CHECK(meets);
  CHECK(geometry::difference(across[0].cover_from_room, across[1].cover_from_room) == 0);
  CHECK(by_word.at("1").size() == 1);
  CHECK(!by_word.at("1")[0].wedge);
}

TEST_CASE("after each number of bounces the wedges fill the whole round", "[cover]") {
  auto room = mirror_room(GENERATE("*(3/2)(12)(12)", "*(2.5)(2.5)(2.5)(2.5)", "*(3.5)(3.5)(3.5)", "*(2.5)(2.5)(2.5)"), true);
  const auto copies = beams_of(room, {9, 0, 0, {}});
  std::map<std::pair<int, int>, double> round;
  std::map<int, double> of_bounces;
  for (const auto& copy : copies) {
    if (copy.bounces == 0) continue;
    REQUIRE(copy.wedge);
    CHECK(angle(*copy.wedge) > 0);
    round[{copy.bounces, copy.sheet}] += angle(*copy.wedge);
  }
  // On S² a copy in which all rays meet again counts on two sheets.
  for (const auto& [key, sum] : round) of_bounces[key.first] += sum;
  for (const auto& [bounces, sum] : of_bounces) {
    if (room.polygon.space != Space::spherical) CHECK(sum == Approx(2 * M_PI).epsilon(1e-9));
    CHECK(sum >= 2 * M_PI * (1 - 1e-9));
  }
  CHECK(of_bounces.size() == 9);
}

TEST_CASE("plain parts of walls end beams", "[cover]") {
  auto room = mirror_room("*2222");
  room.mirrors.resize(1);
  CHECK(beams_of(room, {6, 0, 0, {}}).size() == 2);
  auto two = mirror_room("*2222");
  two.mirrors.erase(two.mirrors.begin() + 1, two.mirrors.begin() + 2);
  two.mirrors.erase(two.mirrors.begin() + 2);
  CHECK(beams_of(two, {6, 0, 0, {}}).size() == 13);   // opposite: a row of 2·6 + 1
}

TEST_CASE("mirrors above each other that differ divide what is seen by height bounds", "[cover]") {
  auto room = mirror_room("*2222");
  room.mirrors.resize(1);
  room.mirrors[0].height[1] = 0.4;
  room.mirrors.push_back({0, {0, room.polygon.walls[0].length}, {0.5, 1}, {0.5, 0.5, 0.5}});
  const auto copies = beams_of(room, {6, 0, 0, {}});
  REQUIRE(copies.size() == 3);
  for (std::size_t i = 1; i < 3; ++i) {
    REQUIRE(copies[i].wedge);
    REQUIRE(copies[i].height_bounds.size() == 1);
    CHECK(copies[i].height_bounds[0].z == Approx(0.45));  // in the middle of the wall between them
    CHECK(copies[i].weight.r == Approx(copies[i].height_bounds[0].above ? 0.5 : 0.9));
  }
  CHECK(copies[1].height_bounds[0].above != copies[2].height_bounds[0].above);
  room.mirrors.back().throughput = {0.9, 0.9, 0.9};
  const auto alike = beams_of(room, {6, 0, 0, {}});
  REQUIRE(alike.size() == 2);
  CHECK((!alike[1].wedge && alike[1].height_bounds.empty()));
}

TEST_CASE("a bundle of rays keeps the height bounds that are not implied", "[cover]") {
  using cover::HeightBound;
  const auto bound = [](double distance, double z, bool above) { return HeightBound{{-distance, 1, 0}, 0, z, above}; };
  const double eye = 0.5;
  std::vector<HeightBound> bounds;
  bounds = cover::with_bound(bounds, bound(1, 0.8, false), eye);
  bounds = cover::with_bound(bounds, bound(2, 0.8, false), eye);  // lower, being farther
  REQUIRE(bounds.size() == 1);
  CHECK(bounds[0].line.w == -2);
  bounds = cover::with_bound(bounds, bound(3, 0.8, true), eye);
  bounds = cover::with_bound(bounds, bound(4, 0.8, true), eye);  // passed anyway
  REQUIRE(bounds.size() == 2);
  CHECK(bounds[1].line.w == -3);
  bounds = cover::with_bound(bounds, bound(4, 0.2, true), eye);  // below the eye
  CHECK(bounds.size() == 2);
  const cover::Wedge wedge{{std::cos(0.1), -std::sin(0.1)}, {std::cos(0.1), std::sin(0.1)}};
  const auto passes = [&](const std::vector<HeightBound>& all, double low, double high) {
    return !cover::is_blocked(Space::euclidean, all, {bound(5, low, true), bound(5, high, false)}, wedge, eye);
  };
  CHECK(passes(bounds, 0, 1.3));
  CHECK(!passes(bounds, 0, 0.9));
  CHECK(!passes({bound(1, 0.8, true), bound(1, 0.7, false)}, 0, 1));
}

TEST_CASE("a height bound is met where the ray meets its wall, in every space and half turn", "[cover]") {
  const Space space = GENERATE(Space::spherical, Space::euclidean, Space::hyperbolic);
  const geometry::Point a = geometry::point_along(space, {}, {0, 1, 0}, 0.5), b = geometry::point_along(space, {}, {0, 0, 1}, 0.7);
  const cover::HeightBound bound{geometry::line_through(space, a, b), 0, 1, false};
  CHECK(cover::distance_to(space, bound, {1, 0}) == Approx(0.5).epsilon(1e-12));
  CHECK(cover::distance_to(space, bound, {0, 1}) == Approx(0.7).epsilon(1e-12));
  CHECK(cover::slope_of(space, bound, {0, 1}, 0.5) == Approx(0.5 / 0.7));
  if (space == Space::spherical) {
    const cover::HeightBound round{geometry::reversed(bound.line), 1, 1, false};
    CHECK(cover::distance_to(space, round, {1, 0}) == Approx(0.5 + M_PI).epsilon(1e-12));
  }
}

TEST_CASE("too many beams are refused with bounces that fit", "[cover]") {
  const auto room = mirror_room("*(2.5)(2.5)(2.5)(2.5)", true);
  const auto copies = cover::unfold_by_beams(room, eye_in(room), {30, 0, 0, {}}, {1000, {}});
  REQUIRE(!copies);
  CHECK(copies.error().front().code == "cover.too-much");
  const std::string hint = copies.error().front().hint;
  const int fits = std::stoi(hint.substr(hint.find(':') + 1));
  CHECK(fits > 1);
  CHECK(cover::unfold_by_beams(room, eye_in(room), {fits, 0, 0, {}}, {1000, {}}));
  CHECK(!cover::unfold_by_beams(room, eye_in(room), {fits + 1, 0, 0, {}}, {1000, {}}));
}

TEST_CASE("mirrors on floor and ceiling stack storeys", "[cover]") {
  auto room = mirror_room("*2222");
  room.height = 2;
  room.mirrors.clear();
  room.mirrors.push_back({-2, {0, 0}, {0, 0}, {0.5, 0.5, 0.5}});
  const auto one = cover::unfold(room, eye_in(room), {6, 0, 0, {}});
  REQUIRE(one);
  REQUIRE(one->size() == 2);
  CHECK((*one)[1].storey.sign == -1);
  CHECK((*one)[1].storey.offset == 4);
  room.mirrors.push_back({-1, {0, 0}, {0, 0}, {0.8, 0.8, 0.8}});
  const auto both = cover::unfold(room, eye_in(room), {3, 0, 0, {}});
  REQUIRE(both);
  REQUIRE(both->size() == 7);
  std::map<int, cover::Copy> by_number;
  for (const auto& copy : *both) by_number[copy.storey.number] = copy;
  CHECK(by_number[-1].storey.offset == 0);
  CHECK(by_number[2].storey.offset == 4);
  CHECK(by_number[-3].storey.offset == -4);
  CHECK(by_number[3].weight.r == Approx(0.5 * 0.8 * 0.5));
  CHECK(by_number[-3].weight.r == Approx(0.8 * 0.5 * 0.8));
  const auto with_walls = [&] {
    auto full = mirror_room("*2222");
    full.mirrors.push_back({-2, {0, 0}, {0, 0}, {0.5, 0.5, 0.5}});
    return cover::unfold(full, eye_in(full), {2, 0, 0, {}})->size();
  }();
  CHECK(with_walls == 13 + 5);   // as many again on the storey above, with a bounce less
}
