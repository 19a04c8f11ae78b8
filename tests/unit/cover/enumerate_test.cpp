#include "compiler/cover/enumerate.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "tests/unit/cover/field_group.h"

namespace orbc::cover {
namespace {

using geometry::Isometry;
using geometry::Space;
using test::orbifold;

// The walls of a regular polygon about the origin; inside is left.
std::vector<Isometry> regular_reflections(Space space, int walls, double inradius) {
  std::vector<Isometry> reflections;
  const double s = geometry::sin_k(space, inradius), c = geometry::cos_k(space, inradius);
  for (int i = 0; i < walls; ++i) {
    const double phi = 2 * std::numbers::pi * i / walls;
    reflections.push_back(geometry::reflection(space, {s, -c * std::cos(phi), -c * std::sin(phi)}));
  }
  return reflections;
}

std::vector<Isometry> pentagon() {
  return regular_reflections(Space::hyperbolic, 5, std::atanh(std::sqrt(std::cos(2 * std::numbers::pi / 5))));
}

TEST_CASE("a stream visits a word before its continuations and smaller walls first", "[cover]") {
  std::vector<Word> words;
  CHECK(
      enumerate(Automaton(orbifold("*222")), 3, [&](const Element& e) { return words.emplace_back(e.word.begin(), e.word.end()), true; }));
  CHECK(words == std::vector<Word>{{}, {0}, {0, 1}, {0, 1, 2}, {0, 2}, {1}, {1, 2}, {2}});
}

TEST_CASE("a visitor leaves out what lies behind a word", "[cover]") {
  std::size_t visited = 0, behind = 0;
  CHECK(enumerate(Automaton(orbifold("*22222")), 4, [&](const Element& e) {
    ++visited;
    behind += e.word.size() > 1 && e.word[0] == 2;
    return !(e.word.size() == 1 && e.word[0] == 2);
  }));
  CHECK(behind == 0);
  CHECK(visited < 166);
  visited = 0;
  CHECK(enumerate(Automaton(orbifold("*22222")), 4, [&](const Element&) { return ++visited, Visit::prune; }));
  CHECK(visited == 1);
}

TEST_CASE("a visitor ends the stream", "[cover]") {
  std::size_t visited = 0;
  CHECK_FALSE(
      enumerate(Automaton(orbifold("*22222")), 100, [&](const Element&) { return ++visited == 17 ? Visit::stop : Visit::descend; }));
  CHECK(visited == 17);
}

TEST_CASE("a stream of length zero shows the room itself", "[cover]") {
  for (const int length : {0, -1}) {
    std::size_t visited = 0;
    CHECK(enumerate(Automaton(orbifold("*237")), length, [&](const Element& e) { return ++visited, e.word.empty(); }));
    CHECK(visited == 1);
  }
}

TEST_CASE("each copy comes with the product of its reflections", "[cover]") {
  const Automaton automaton(orbifold("*22222"));
  const std::vector<Isometry> reflections = pentagon();
  std::size_t visited = 0;
  double worst = 0;
  enumerate(automaton, reflections, 6, [&](const Element& e, const Isometry& cover_from_room) {
    Isometry product = geometry::identity(Space::hyperbolic);
    for (const std::uint8_t wall : e.word) product = product * reflections[wall];
    worst = std::max(worst, geometry::difference(product, cover_from_room) / std::abs(product.a));
    return ++visited, true;
  });
  CHECK(visited == 1161);
  CHECK(worst < 1e-14);
}

TEST_CASE("pruning keeps words and isometries together", "[cover]") {
  const std::vector<Isometry> reflections = pentagon();
  double worst = 0;
  enumerate(Automaton(orbifold("*22222")), reflections, 9, [&](const Element& e, const Isometry& cover_from_room) {
    Isometry product = geometry::identity(Space::hyperbolic);
    for (const std::uint8_t wall : e.word) product = product * reflections[wall];
    worst = std::max(worst, geometry::difference(product, cover_from_room) / std::abs(product.a));
    return e.word.size() < 3 || e.word.back() != 1;
  });
  CHECK(worst < 1e-13);
}

TEST_CASE("the walls that shorten a word face the room", "[cover]") {
  // The line of wall i seen from copy g separates g from the room exactly when g·s_i is shorter.
  const std::vector<Isometry> reflections = pentagon();
  const double r = std::atanh(std::sqrt(std::cos(2 * std::numbers::pi / 5)));
  bool agree = true;
  enumerate(Automaton(orbifold("*22222")), reflections, 6, [&](const Element& e, const Isometry& cover_from_room) {
    const geometry::Point eye = geometry::inverse(cover_from_room) * geometry::Point();
    for (int i = 0; i < 5; ++i) {
      const double phi = 2 * std::numbers::pi * i / 5;
      const geometry::Line wall{std::sinh(r), -std::cosh(r) * std::cos(phi), -std::cosh(r) * std::sin(phi)};
      agree = agree && (geometry::value_at(wall, eye) < 0) == ((e.descents >> i & 1) == 1);
    }
    return true;
  });
  CHECK(agree);
}

TEST_CASE("a thousand mirrors away the isometry is still one", "[cover]") {
  // The strip: the only words alternate, the copies march along the axis.
  const std::vector<Isometry> reflections = {geometry::reflection(Space::euclidean, {1, -1, 0}),
                                             geometry::reflection(Space::euclidean, {1, 1, 0})};
  double worst = 0;
  std::size_t visited = 0;
  enumerate(Automaton(orbifold("**"), 2000), reflections, 2000, [&](const Element& e, const Isometry& cover_from_room) {
    const geometry::Point centre = cover_from_room * geometry::Point();
    worst = std::max(worst, std::abs(std::abs(centre.x) - 2.0 * static_cast<double>(e.word.size())));
    return ++visited, true;
  });
  CHECK(visited == 4001);
  CHECK(worst < 1e-9);
}

TEST_CASE("rooms of hundreds of walls stream as well", "[cover]") {
  notation::Orbifold many;
  for (int i = 0; i < 256; ++i) many.corners.emplace_back(2 + i % 7);
  std::size_t visited = 0;
  enumerate(Automaton(many), 2, [&](const Element&) { return ++visited, true; });
  // 256·255 ordered pairs, less one for each corner of order 2.
  CHECK(visited == 1 + 256 + 256 * 255 - 37);
}

}  // namespace
}  // namespace orbc::cover
