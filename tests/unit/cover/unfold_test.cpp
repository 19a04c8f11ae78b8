#include "compiler/cover/unfold.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "compiler/cover/beam.h"
#include "compiler/cover/plan.h"
#include "compiler/notation/parse.h"
#include "compiler/room/realise.h"

using namespace orbc;
using geometry::Point;
using geometry::Space;

namespace {

place::Interior room_of_mirrors(const std::string& notation, double reflectance = 0.9) {
  const auto orbifold = notation::parse(notation);
  REQUIRE(orbifold);
  auto room = room::realise(*orbifold);
  REQUIRE(room);
  place::Interior placed;
  placed.polygon = std::move(room).value();
  for (std::size_t i = 0; i < placed.polygon.walls.size(); ++i) {
    if (placed.polygon.walls[i].reflects)
      placed.mirrors.push_back({static_cast<int>(i), {0, placed.polygon.walls[i].length}, {0, 1}, {reflectance, reflectance, reflectance}});
  }
  placed.parts.emplace_back();
  placed.parts[0].floor.resize(100);
  placed.parts[0].triangles.resize(150);
  return placed;
}

place::Camera eye_of(const place::Interior& room) {
  place::Camera eye;
  eye.room_from_eye = geometry::translation_by(room.polygon.space, 0.05, 0.03);
  eye.z = 0.5;
  return eye;
}

std::vector<cover::Copy> copies_of(const place::Interior& room, const scene::CoverSpec& spec) {
  const auto copies = cover::unfold(room, eye_of(room), spec);
  if (!copies) FAIL(to_text(copies.error()));
  return *copies;
}

std::string code_of(const place::Interior& room, const scene::CoverSpec& spec, const cover::UnfoldOptions& options = {}) {
  const auto copies = cover::unfold(room, eye_of(room), spec, options);
  REQUIRE(!copies);
  return copies.error().front().code;
}

}  // namespace

TEST_CASE("the paper's room has 166 copies within four bounces", "[cover]") {
  const auto room = room_of_mirrors("*22222");
  const auto copies = copies_of(room, {4, 0, 0, {}});
  CHECK(copies.size() == 166);
  CHECK(copies.front().word.empty());
  CHECK(copies.front().bounces == 0);
  CHECK(geometry::difference(copies.front().cover_from_room, geometry::identity(Space::hyperbolic)) == 0);
}

TEST_CASE("copies come by bounces, then by word, each once, with the weight of their mirrors", "[cover]") {
  const auto room = room_of_mirrors(GENERATE("*22222", "*2323", "*237", "*333", "*244", "*2222", "*222", "*235", "*33", "*"));
  const auto copies = copies_of(room, {9, 0, 0, {}});
  std::set<std::pair<int, cover::Word>> seen;
  for (std::size_t i = 0; i < copies.size(); ++i) {
    const auto& copy = copies[i];
    CHECK(seen.emplace(copy.sheet, copy.word).second);
    CHECK(copy.weight.r == Approx(std::pow(0.9, copy.bounces)).epsilon(1e-14));
    CHECK(copy.cover_from_room.reversing == (copy.word.size() % 2 == 1));
    if (copy.sheet == 0) CHECK(copy.bounces == static_cast<int>(copy.word.size()));
    if (i == 0) continue;
    const auto& before = copies[i - 1];
    CHECK(std::make_tuple(before.bounces, before.sheet, before.word) < std::make_tuple(copy.bounces, copy.sheet, copy.word));
  }
}

TEST_CASE("a wall belongs to the nearer copy exactly when it separates its copy from the eye", "[cover]") {
  const auto room = room_of_mirrors(GENERATE("*22222", "*2323", "*237", "*333", "*236", "*222", "*235", "**", "*22∞"));
  const auto eye = eye_of(room);
  for (const auto& copy : copies_of(room, {8, 0, 0, {}})) {
    if (copy.sheet > 0) continue;
    const Point here = inverse(copy.cover_from_room) * (eye.room_from_eye * Point());
    for (std::size_t i = 0; i < room.polygon.walls.size(); ++i) {
      if (!room.polygon.walls[i].reflects) continue;
      CHECK(((copy.eye_facing_walls >> i) & 1) == (geometry::value_at(room.polygon.walls[i].line, here) < 0));
    }
  }
}

TEST_CASE("on the sphere the whole group comes back sheet after sheet", "[cover]") {
  const struct {
    const char* notation;
    std::size_t order;
    int half_turn;
  } groups[] = {{"*222", 8, 3}, {"*235", 120, 15}, {"*33", 6, 3}, {"*", 2, 1}};
  for (const auto& group : groups) {
    CAPTURE(group.notation);
    const auto room = room_of_mirrors(group.notation);
    const auto copies = copies_of(room, {2 * group.half_turn, 0, 0, {}});
    // Sheets 0 and 1 are complete, of sheet 2 only the room itself is reached.
    CHECK(copies.size() == 2 * group.order + 1);
    for (const auto& copy : copies) {
      const int length = static_cast<int>(copy.word.size());
      CHECK(copy.bounces == (copy.sheet == 0 ? length : copy.sheet == 1 ? 2 * group.half_turn - length : 2 * group.half_turn));
    }
    // On sheet 1 the eye comes from the other side.
    for (const auto& copy : copies) {
      if (copy.sheet != 1 || !copy.word.empty()) continue;
      CHECK(copy.eye_facing_walls == (std::uint64_t{1} << room.polygon.walls.size()) - 1);
    }
    const auto planned = cover::plan(room, eye_of(room), {2 * group.half_turn, 0, 0, {}});
    REQUIRE(planned);
    CHECK(planned->copies == copies.size());
    CHECK(planned->sheets == 3);
  }
}

TEST_CASE("a path ends before its weight falls below the least one", "[cover]") {
  const auto room = room_of_mirrors("*22222", 0.8);
  int most = 0;
  for (const auto& copy : copies_of(room, {100, 0.5, 0, {}})) most = std::max(most, copy.bounces);
  CHECK(most == 3);  // 0.8³ = 0.512, 0.8⁴ = 0.41
  auto tinted = room_of_mirrors("*22222", 0.8);
  for (auto& mirror : tinted.mirrors) mirror.throughput = {0.8, 0.4, 0.08};
  CHECK(copies_of(tinted, {100, 0.5, 0, {}}).back().bounces == 3);
  CHECK(copies_of(tinted, {100, 0.5, 0, {}}).back().weight.b == Approx(std::pow(0.08, 3)));
}

TEST_CASE("behind a plain wall there are no copies", "[cover]") {
  auto room = room_of_mirrors("*333");
  room.mirrors.erase(room.mirrors.begin() + 1);
  const auto copies = copies_of(room, {10, 0, 0, {}});
  CHECK(copies.size() == 6);  // walls 1 and 3 make the dihedral group of order 6
  for (const auto& copy : copies) {
    for (const auto wall : copy.word) CHECK(wall != 1);
    CHECK((copy.eye_facing_walls & 2) == 0);
  }
  room.mirrors.clear();
  CHECK(copies_of(room, {10, 0, 0, {}}).size() == 1);
  auto sphere = room_of_mirrors("*235");
  sphere.mirrors.erase(sphere.mirrors.begin());
  for (const auto& copy : copies_of(sphere, {100, 0, 0, {}})) CHECK(copy.sheet == 0);
}

TEST_CASE("the strip unfolds through its two mirrors only", "[cover]") {
  const auto room = room_of_mirrors("**");
  const auto copies = copies_of(room, {7, 0, 0, {}});
  CHECK(copies.size() == 15);
  for (const auto& copy : copies) {
    for (const auto wall : copy.word) CHECK((wall == 0 || wall == 2));
    CHECK((copy.eye_facing_walls & 0b1010) == 0);
  }
}

TEST_CASE("the half strip unfolds through its three mirrors only", "[cover]") {
  const auto room = room_of_mirrors("*22∞");
  const auto copies = copies_of(room, {7, 0, 0, {}});
  CHECK(copies.size() == 28);  // 15 of the strip, and 13 behind the mirror across
  for (const auto& copy : copies) {
    for (const auto wall : copy.word) CHECK(wall != 2);
    CHECK((copy.eye_facing_walls & 0b100) == 0);
  }
}

TEST_CASE("leaving out small copies loses no large one", "[cover]") {
  const auto room = room_of_mirrors(GENERATE("*22222", "*237", "*2323", "*333"));
  const int bounces = room.polygon.space == Space::euclidean ? 60 : room.polygon.walls.size() == 3 ? 36 : 14;
  const auto all = copies_of(room, {bounces, 0, 0, {}}), some = copies_of(room, {bounces, 0, 20, {}});
  std::set<std::string> kept;
  for (const auto& copy : some) kept.insert(cover::to_string(copy.word));
  const auto eye = eye_of(room);
  std::size_t large = 0;
  for (const auto& copy : all) {
    const Point centre = inverse(eye.room_from_eye) * (copy.cover_from_room * Point());
    const double d = geometry::arc_k(room.polygon.space, centre.w, std::hypot(centre.x, centre.y)), radius = room.polygon.circumradius;
    if (d > radius) {
      const double width = 2 * std::asin(geometry::sin_k(room.polygon.space, radius) / geometry::sin_k(room.polygon.space, d));
      const double height = std::atan(0.5 / (d - radius)) * 2;
      if (std::min(width, height) * place::pixels_per_radian(eye) < 20) continue;
    }
    ++large;
    CHECK(kept.count(cover::to_string(copy.word)) == 1);
  }
  CHECK(large == some.size());
  CHECK(some.size() < all.size());
  const auto planned = cover::plan(room, eye, {bounces, 0, 20, {}});
  REQUIRE(planned);
  CHECK(planned->copies == some.size());
}

TEST_CASE("rooms that the group does not tell go by beams, and are planned alike", "[cover]") {
  auto mixed = room_of_mirrors("*333");
  mixed.mirrors[2].throughput = {0.8, 0.8, 0.8};
  auto storeys = room_of_mirrors("*333");
  storeys.mirrors.push_back({-2, {0, 1}, {0, 1}, {0.9, 0.9, 0.9}});
  CHECK(copies_of(mixed, {4, 0, 0, {}}).size() > copies_of(room_of_mirrors("*333"), {4, 0, 0, {}}).size());
  for (const auto& room : {mixed, storeys}) {
    const auto copies = copies_of(room, {4, 0, 0, {}});
    const auto planned = cover::plan(room, eye_of(room), {4, 0, 0, {}});
    REQUIRE(planned);
    CHECK(planned->copies == copies.size());
  }
}

TEST_CASE("the plan counts exactly and names what fits", "[cover]") {
  const auto room = room_of_mirrors("*22222");
  const auto eye = eye_of(room);
  const auto small = cover::plan(room, eye, {4, 0, 0, {}});
  REQUIRE(small);
  CHECK(small->copies == 166);
  CHECK(small->triangles == 166 * 150);
  CHECK(small->vertices == 166 * 100);
  // A copy takes 200 bytes itself, whatever is drawn of it: 166 copies fit into 40,000, those of five bounces do not.
  const auto planned = cover::plan(room, eye, {1000000, 0, 0, {}}, {40'000});
  REQUIRE(!planned);
  CHECK(planned.error().front().code == "cover.too-much");
  CHECK(planned.error().front().hint == "max_bounces: 4 fits");
  cover::UnfoldOptions options;
  options.max_copies = 200;
  CHECK(code_of(room, {1000, 0, 0, {}}, options) == "cover.too-much");
  const auto plain = [] {
    auto closed = room_of_mirrors("*22222");
    closed.mirrors.pop_back();
    return closed;
  }();
  const auto walked = cover::plan(plain, eye, {1000, 0, 0, {}}, {40'000});
  REQUIRE(!walked);
  CHECK(walked.error().front().code == "cover.too-much");
  CHECK(cover::plan(plain, eye, {4, 0, 0, {}})->copies == copies_of(plain, {4, 0, 0, {}}).size());
}

TEST_CASE("the group enumerates copies of mirrors that are alike and of integer corners only", "[cover]") {
  auto room = room_of_mirrors("*22222");
  CHECK_FALSE(cover::needs_beams(room));
  room.mirrors[1].throughput = {0.5, 0.5, 0.5};
  CHECK(cover::needs_beams(room));
  auto real = room_of_mirrors("*22222");
  real.polygon.orbifold.corners[0] = Rational(5, 2);
  CHECK(cover::needs_beams(real));
}
