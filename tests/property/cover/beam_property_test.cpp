// Laws of beams over random rooms and eyes: they find the group's copies; unequal weights cut a copy into wedges that fill what the copy
// fills; every bearing leads to one copy after each number of bounces; following one ray by hand meets the mirrors of the wedge that holds
// it.
#include <catch2/catch.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "compiler/cover/beam.h"
#include "compiler/cover/unfold.h"
#include "compiler/notation/growth.h"
#include "compiler/notation/parse.h"
#include "tests/support/mirror_room.h"

using namespace orbc;
using geometry::Space;

namespace {

using test::mirror_room;

std::string one_order(int k) { return std::string("(").append(std::to_string(k)).append(")"); }

/// A random orbifold of any space, small corners and large ones.
std::string random_orbifold(std::mt19937& random) {
  static const char* const rest[] = {"*", "*233", "*234", "*235", "*333", "*244", "*236", "*2222"};
  const std::string k = one_order(2 + static_cast<int>(random() % 15));
  switch (random() % 6) {
    case 0: return std::string("*").append(k).append(k);
    case 1: return std::string("*22").append(k);
    case 2: return rest[random() % std::size(rest)];
    default: break;
  }
  for (;;) {
    std::string text = "*";
    const int corners = 3 + static_cast<int>(random() % 6);
    double sum = 0;
    for (int i = 0; i < corners; ++i) {
      const int order = 2 + static_cast<int>(random() % (random() % 3 ? 4 : 20));
      text += one_order(order);
      sum += 0.5 / order;
    }
    if (sum - corners / 2.0 + 1 < -1e-9) return text;
  }
}

/// An eye anywhere in the room: a mixture of its corners and its centre; now and then close to a corner or a wall.
place::Camera random_eye(const place::Interior& room, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.01, 1);
  geometry::Ambient at{unit(random) * (random() % 3 ? 1 : 0.01), 0, 0};
  const double power = random() % 3 ? 1 : 12;
  for (const auto& p : room.polygon.outline) at = at + std::pow(unit(random) * unit(random), power) * p;
  place::Camera eye;
  const auto point = geometry::normalised_point(room.polygon.space, (room.polygon.space == Space::euclidean ? 1 / at.w : 1.0) * at);
  eye.room_from_eye = geometry::translation_to(room.polygon.space, point) * geometry::rotation(room.polygon.space, 6.28 * unit(random));
  eye.z = 0.5;
  return eye;
}

std::vector<cover::Copy> beams_of(const place::Interior& room, const place::Camera& eye, int bounces) {
  const auto copies = cover::unfold_by_beams(room, eye, {bounces, 0, 0, {}});
  if (!copies) FAIL(to_text(copies.error()));
  return *copies;
}

/// S²: past the antipode, and past the eye itself.
int bounces_for(const place::Interior& room) {
  if (room.polygon.space == Space::spherical) return 2 * static_cast<int>(notation::longest_length(room.polygon.orbifold).value()) + 3;
  return room.polygon.space == Space::euclidean ? 12 : room.polygon.walls.size() == 3 ? 9 : room.polygon.walls.size() < 6 ? 5 : 4;
}

bool holds(const cover::Wedge& w, double angle) {
  const cover::Bearing b{std::cos(angle), std::sin(angle)};
  return cover::cross(w.from, b) > 1e-9 && cover::cross(b, w.to) > 1e-9;
}

}  // namespace

namespace {

void compare_with_group(int trials, unsigned seed) {
  std::mt19937 random(seed);
  for (int trial = 0; trial < trials; ++trial) {
    const std::string text = random_orbifold(random);
    const auto room = mirror_room(text, true);
    const auto eye = random_eye(room, random);
    INFO(text << " trial " << trial);
    const int bounces = bounces_for(room);
    const auto a = beams_of(room, eye, bounces);
    const auto b = cover::unfold(room, eye, {bounces, 0, 0, {}});
    REQUIRE(b);
    REQUIRE(a.size() == b->size());
    bool alike = true;
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const auto &x = a[i], &y = (*b)[i];
      alike =
          alike && x.word == y.word && x.sheet == y.sheet && x.bounces == y.bounces && x.eye_facing_walls == y.eye_facing_walls && !x.wedge;
      worst = std::max(worst, geometry::difference(x.cover_from_room, y.cover_from_room));
    }
    CHECK(alike);
    CHECK(worst <= 1e-12);
  }
}

}  // namespace

TEST_CASE("beams of uniform rooms are the group's copies, whole, from any eye", "[cover][property]") { compare_with_group(200, 4711); }
TEST_CASE("the same for thousands of rooms", "[.][slow]") { compare_with_group(4000, 4714); }

TEST_CASE("copies cut by weight have the paths' own weights, and fit together", "[cover][property]") {
  std::mt19937 random(4712);
  for (int trial = 0; trial < 60; ++trial) {
    const std::string text = random_orbifold(random);
    auto room = mirror_room(text, true);
    for (auto& mirror : room.mirrors) {
      const double reflectance = 0.5 + 0.4 * static_cast<double>(random() % 1000) / 1000;
      mirror.throughput = {reflectance, reflectance, reflectance};
    }
    const auto eye = random_eye(room, random);
    INFO(text << " trial " << trial);
    const auto copies = beams_of(room, eye, bounces_for(room));
    std::map<std::string, std::vector<const cover::Copy*>> of_element;
    for (const auto& copy : copies) of_element[std::to_string(copy.sheet) + ":" + cover::to_string(copy.word)].push_back(&copy);
    for (const auto& [name, pieces] : of_element) {
      if (pieces.size() == 1) continue;
      int loose = 0;
      for (const auto* piece : pieces) {
        REQUIRE(piece->wedge);
        CHECK(geometry::difference(piece->cover_from_room, pieces.front()->cover_from_room) == 0);
        loose += std::none_of(pieces.begin(), pieces.end(), [&](const auto* other) { return other->wedge->from == piece->wedge->to; });
      }
      // A whole room has two ends; one around the eye's antipode has none.
      CHECK(loose <= 1);
    }
    // The number of elements is the group's, whatever the weights.
    for (auto& mirror : room.mirrors) mirror.throughput = {0.9, 0.9, 0.9};
    CHECK(of_element.size() == cover::unfold(room, eye, {bounces_for(room), 0, 0, {}})->size());
  }
}

TEST_CASE("in rooms that are no orbifolds every bearing meets the walls of its wedge's word", "[cover][property]") {
  std::mt19937 random(4713);
  for (const char* text : {"*(3/2)(12)(12)", "*(2.5)(2.5)(2.5)(2.5)", "*(2.5)44", "*(2.5)(2.5)(2.5)", "*(7/3)23", "*(3.5)(4.5)(3.5)"}) {
    const auto room = mirror_room(text, true);
    const auto eye = random_eye(room, random);
    INFO(text);
    const auto copies = beams_of(room, eye, 7);
    std::uniform_real_distribution<double> angles(-M_PI, M_PI);
    for (int ray = 0; ray < 200; ++ray) {
      const double angle = angles(random);
      // Follows the ray in the room itself: the wall met first, then its mirror image.
      const Space space = room.polygon.space;
      geometry::Point at = eye.room_from_eye * geometry::Point();
      geometry::Tangent along = eye.room_from_eye * geometry::Tangent(0, std::cos(angle), std::sin(angle));
      cover::Word word;
      for (int bounce = 0; bounce < 7; ++bounce) {
        double best = 1e9;
        int wall = -1;
        for (int i = 0; i < static_cast<int>(room.polygon.walls.size()); ++i) {
          if (!word.empty() && word.back() == i) continue;
          // Zero of l_P·cosκ s + l_V·sinκ s.
          const auto& line = room.polygon.walls[static_cast<std::size_t>(i)].line;
          const double p = value_at(line, at), v = value_at(line, along);
          double s = 1e9;
          if (space == Space::spherical) s = std::atan2(p, -v);
          else if (v < 0 && (space == Space::euclidean || -v > p)) s = geometry::atan_k(space, -p / v);
          if (s > 0 && s < best) best = s, wall = i;
        }
        const auto next = geometry::point_along(space, at, along, best);
        const auto direction = geometry::direction_along(space, at, along, best);
        const auto mirror = room::reflection_in_wall(room.polygon, wall);
        at = mirror * next;
        along = geometry::normalised_tangent(space, at, mirror * direction);
        word.push_back(static_cast<std::uint8_t>(wall));
      }
      int found = 0;
      for (const auto& copy : copies) {
        if (copy.bounces != 7 || !copy.wedge || !holds(*copy.wedge, angle)) continue;
        CHECK(cover::to_string(copy.word) == cover::to_string(word));
        ++found;
      }
      // On S² the copy where rays meet again is seen on two sheets.
      CHECK(found >= 1);
      CHECK(found <= (space == Space::spherical ? 2 : 1));
    }
  }
}

TEST_CASE("of mirrors above each other each ray has its own, in one piece of the copy it meets", "[cover][property]") {
  std::mt19937 random(4715);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 40; ++trial) {
    const std::string text = random_orbifold(random);
    auto room = mirror_room(text, true);
    const Space space = room.polygon.space;
    std::vector<double> divided(room.polygon.walls.size(), 2);   // the height that divides a wall, or one above all
    const std::size_t walls = room.mirrors.size();
    for (std::size_t i = 0; i < walls; ++i) {
      if (random() % 2) continue;
      const auto wall = static_cast<std::size_t>(room.mirrors[i].wall);
      divided[wall] = 0.2 + 0.6 * unit(random);
      room.mirrors[i].height[1] = divided[wall];
      room.mirrors.push_back({room.mirrors[i].wall, {0, room.polygon.walls[wall].length}, {divided[wall], 1}, {0.5, 0.5, 0.5}});
    }
    const auto eye = random_eye(room, random);
    INFO(text << " trial " << trial);
    const int most = std::min(bounces_for(room), 6);
    const auto copies = beams_of(room, eye, most);
    for (int ray = 0; ray < 60; ++ray) {
      const double angle = 6.283 * unit(random), slope = (unit(random) - 0.5) * unit(random);
      geometry::Point at = eye.room_from_eye * geometry::Point();
      geometry::Tangent along = eye.room_from_eye * geometry::Tangent(0, std::cos(angle), std::sin(angle));
      double length = 0, weight = 1;
      int last = -1;
      for (int bounces = 1; bounces <= most; ++bounces) {
        double best = 1e9;
        int wall = -1;
        for (int i = 0; i < static_cast<int>(room.polygon.walls.size()); ++i) {
          if (i == last && space != Space::spherical) continue;
          const auto& line = room.polygon.walls[static_cast<std::size_t>(i)].line;
          const double p = i == last ? 0 : value_at(line, at), v = value_at(line, along);
          double s = 1e9;
          if (space == Space::spherical) s = i == last ? M_PI : std::atan2(p, -v);
          else if (v < 0 && (space == Space::euclidean || -v > p)) s = geometry::atan_k(space, -p / v);
          if (s > 0 && s < best) best = s, wall = i;
        }
        if (wall < 0 || !room.polygon.walls[static_cast<std::size_t>(wall)].reflects) break;
        length += best;
        const double z = eye.z + slope * length;
        if (z < 0.001 || z > 0.999 || std::fabs(z - divided[static_cast<std::size_t>(wall)]) < 1e-6) break;
        weight *= z > divided[static_cast<std::size_t>(wall)] ? 0.5 : 0.9;
        const auto mirror = room::reflection_in_wall(room.polygon, wall);
        const auto next = geometry::point_along(space, at, along, best);
        const auto direction = geometry::direction_along(space, at, along, best);
        at = mirror * next;
        along = geometry::normalised_tangent(space, at, mirror * direction);
        last = wall;
        int found = 0, wrong = 0;
        for (const auto& copy : copies) {
          if (copy.bounces != bounces) continue;
          if (!copy.wedge || !holds(*copy.wedge, angle)) continue;   // without a wedge: every ray that meets it has its weight
          const bool seen = std::all_of(copy.height_bounds.begin(), copy.height_bounds.end(), [&](const cover::HeightBound& bound) {
            return bound.above == (slope > cover::slope_of(space, bound, {std::cos(angle), std::sin(angle)}, eye.z));
          });
          if (!seen) continue;
          ++found;
          wrong += std::fabs(copy.weight.r - weight) > 1e-9;
        }
        const bool whole =
            std::any_of(copies.begin(), copies.end(), [&](const auto& copy) { return copy.bounces == bounces && !copy.wedge; });
        INFO("bearing " << angle << " slope " << slope << " bounces " << bounces);
        CHECK(wrong == 0);
        if (!whole) CHECK(found >= 1);
        CHECK(found <= (space == Space::spherical ? 2 : 1));
      }
    }
  }
}
