#include "compiler/cover/automaton.h"

#include <catch2/catch.hpp>
#include <random>

#include "compiler/cover/enumerate.h"
#include "compiler/notation/enumerate.h"
#include "compiler/notation/growth.h"
#include "compiler/notation/print.h"
#include "tests/reference/growth.h"
#include "tests/unit/cover/field_group.h"

namespace orbc::cover {
namespace {

using test::orbifold;

std::vector<Integer> counts(const notation::Orbifold& o, int length) {
  std::vector<Integer> n(static_cast<std::size_t>(length) + 1, 0);
  enumerate(Automaton(o, length), length, [&](const Element& e) { return ++n[e.word.size()], true; });
  return n;
}

std::vector<Integer> expected(const notation::Orbifold& o, int length) {
  std::vector<Integer> n = notation::copies_per_length(o, length);
  n.resize(static_cast<std::size_t>(length) + 1, 0);
  return n;
}

Integer total(const std::vector<Integer>& counts) {
  Integer sum = 0;
  for (const Integer& n : counts) sum += n;
  return sum;
}

// Words, descents and products against plain search among matrices over a finite field.
void check_against_matrices(const notation::Orbifold& o, int length) {
  CAPTURE(notation::to_text(o), length);
  const test::FieldGroup group(o);
  const test::Ball ball = test::ball(group, length, 1500);
  const int depth = static_cast<int>(ball.by_length.size()) - 1;
  const Automaton automaton(o, depth + 1);
  std::vector<std::vector<Word>> words(static_cast<std::size_t>(depth) + 1);
  bool descents_agree = true, one_by_one_agrees = true;
  enumerate(automaton, depth, [&](const Element& e) {
    const Word word(e.word.begin(), e.word.end());
    words[word.size()].push_back(word);
    if (static_cast<int>(word.size()) == depth) return true;
    const test::FieldGroup::Matrix m = group.element(word);
    std::uint64_t shorter = 0;
    for (std::size_t wall = 0; wall < group.walls(); ++wall) {
      const Word& neighbour = ball.normal_forms.at(group.multiply(m, wall));
      if (neighbour.size() < word.size()) shorter |= std::uint64_t{1} << wall;
      one_by_one_agrees = one_by_one_agrees && multiply(automaton, word, static_cast<int>(wall)) == neighbour;
    }
    descents_agree = descents_agree && e.descents == shorter && descents(automaton, word) == shorter && is_normal_form(automaton, word);
    return true;
  });
  CHECK(words == ball.by_length);
  CHECK(descents_agree);
  CHECK(one_by_one_agrees);
}

TEST_CASE("every triangle group lists each element once by its ShortLex form, with its descents", "[cover]") {
  // All corner orders, since the numbers of the walls decide what is lexicographic.
  const int orders[] = {2, 3, 4, 5, 6, 7, 8, 9, 12};
  for (const int a : orders)
    for (const int b : orders)
      for (const int c : orders)
        if (a + b + c < 18) check_against_matrices({{a, b, c}, false}, 40);
}

TEST_CASE("rooms of few and of many walls list each element once by its ShortLex form, with its descents", "[cover]") {
  for (const char* text : {"*",       "**",      "*22∞", "*22",     "*33",      "*77",
                           "*2222",   "*2223",   "*2232",   "*2323",    "*2332",
                           "*3333",   "*2354",   "*4532",   "*2525",    "*22222",
                           "*22223",  "*32222",  "*22333",  "*23456",   "*64253",
                           "*222222", "*252423", "*333333", "*2222222", "*23456789(10)(11)"})
    check_against_matrices(orbifold(text), 12);
}

TEST_CASE("counts equal the growth series at any depth", "[cover]") {
  CHECK(counts(orbifold("*237"), 60) == expected(orbifold("*237"), 60));
  CHECK(counts(orbifold("*237"), 37)[37] == 2818);
  CHECK(counts(orbifold("*666"), 15) == expected(orbifold("*666"), 15));
  CHECK(counts(orbifold("*666"), 15)[15] == 37239);
  CHECK(counts(orbifold("*22222"), 4) == std::vector<Integer>{1, 5, 15, 40, 105});
  for (const char* text : {"*732", "*372", "*(40)32", "*3(1000000)2", "*245", "*2(20)(30)", "*345", "*(10)(10)(10)", "*333", "*244", "*632",
                           "*2222", "**", "*22∞"}) {
    CAPTURE(text);
    CHECK(counts(orbifold(text), 24) == expected(orbifold(text), 24));
  }
}

TEST_CASE("counts equal the reference numbers", "[cover]") {
  for (const reference::Growth& group : reference::growth()) {
    CAPTURE(group.notation);
    std::vector<Integer> n(group.per_length.begin(), group.per_length.end());
    Integer sum = 0;
    std::size_t length = 0;
    while (length < n.size() && sum + n[length] < 400000) sum += n[length++];
    n.resize(length);
    CHECK(counts(orbifold(std::string(group.notation)), static_cast<int>(length) - 1) == n);
  }
}

TEST_CASE("a spherical room has as many copies as its group has elements", "[cover]") {
  std::vector<notation::Orbifold> spherical;
  for (const int corners : {1, 2, 3}) {
    const bool done = notation::enumerate(corners, 40, [&](const notation::Orbifold& o, geometry::Space space) {
                        if (space == geometry::Space::spherical) spherical.push_back(o);
                        return space == geometry::Space::spherical;
                      }).value();
    CHECK(done == (corners < 3));
  }
  CHECK(spherical.size() == 1 + 39 + 39 + 3);
  for (const notation::Orbifold& o : spherical) {
    CAPTURE(notation::to_text(o));
    const int longest = *notation::longest_length(o);
    const std::vector<Integer> n = counts(o, longest + 3);
    CHECK(total(n) == *notation::group_order(o));
    CHECK(n[static_cast<std::size_t>(longest)] == 1);
    CHECK(n[static_cast<std::size_t>(longest) + 1] == 0);
  }
}

TEST_CASE("every orbifold of up to six corners counts as its growth series says", "[cover]") {
  for (const int corners : {3, 4, 5, 6}) {
    CHECK(notation::enumerate(corners, corners == 3 ? 9 : 4, [&](const notation::Orbifold& o, geometry::Space) {
            const int length = corners == 3 ? 14 : 5;
            CAPTURE(notation::to_text(o));
            CHECK(counts(o, length) == expected(o, length));
            return true;
          }).value());
  }
}

TEST_CASE("the table and the computed automaton agree where both apply", "[cover]") {
  for (const char* text : {"*", "**", "*22∞", "*55", "*333", "*345", "*2222", "*2345", "*22222", "*42323"}) {
    CAPTURE(text);
    const MinimalRoots roots(orbifold(text));
    const int length = 7;
    const TableAutomaton table(roots, length);
    const CornerAutomaton computed(roots);
    const auto list = [&](const auto& machine) {
      std::vector<std::pair<Word, std::uint64_t>> all;
      detail::visit_words(
          machine, length, [](std::size_t, int) {},
          [&](const Element& e) {
            return all.push_back({Word(e.word.begin(), e.word.end()), e.descents}), true;
          });
      return all;
    };
    CHECK(list(table) == list(computed));
  }
}

TEST_CASE("minimal roots are as many as the literature says", "[cover]") {
  // Finite groups: all positive roots. Affine: as many as the finite group has roots of both signs. *kkk with k > 2: those of the corners.
  CHECK(MinimalRoots(orbifold("*235")).count() == 15);
  CHECK(MinimalRoots(orbifold("*432")).count() == 9);
  CHECK(MinimalRoots(orbifold("*332")).count() == 6);
  CHECK(MinimalRoots(orbifold("*22(17)")).count() == 18);
  CHECK(MinimalRoots(orbifold("*333")).count() == 6);
  CHECK(MinimalRoots(orbifold("*244")).count() == 8);
  CHECK(MinimalRoots(orbifold("*236")).count() == 12);
  CHECK(MinimalRoots(orbifold("*666")).count() == 15);
  CHECK(MinimalRoots(orbifold("*22222")).count() == 5);
}

TEST_CASE("the image of a minimal root comes back under the same wall", "[cover]") {
  for (const char* text :
       {"*237", "*732", "*245", "*254", "*235", "*532", "*2(30)(40)", "*23(1000)", "*2323", "*77", "*22(100)", "*23456", "*666"}) {
    CAPTURE(text);
    const MinimalRoots roots(orbifold(text));
    bool involutive = true;
    for (MinimalRoots::Root root = 0; root < roots.count(); ++root)
      for (int wall = 0; wall < roots.walls(); ++wall) {
        const MinimalRoots::Root image = roots.image(wall, root);
        involutive = involutive && (image >= 0 ? roots.image(wall, image) == root : image == MinimalRoots::kNotMinimal || root == wall);
      }
    CHECK(involutive);
  }
}

TEST_CASE("all positive roots of a finite group are minimal", "[cover]") {
  for (const char* text : {"*", "*22", "*55", "*222", "*22(17)", "*2(17)2", "*(17)22", "*233", "*432", "*352"}) {
    CAPTURE(text);
    const MinimalRoots roots(orbifold(text));
    bool closed = true;
    for (MinimalRoots::Root root = 0; root < roots.count(); ++root)
      for (int wall = 0; wall < roots.walls(); ++wall) closed = closed && (roots.image(wall, root) >= 0) == (root != wall);
    CHECK(closed);
    CHECK(roots.count() == *notation::longest_length(orbifold(text)));
  }
}

TEST_CASE("any word has the normal form of its element", "[cover]") {
  std::mt19937 random(7);
  for (const char* text : {"*235", "*237", "*732", "*245", "*333", "*22222", "*2323", "**", "*22∞", "*44"}) {
    CAPTURE(text);
    const notation::Orbifold o = orbifold(text);
    const test::FieldGroup group(o);
    const Automaton automaton(o);
    bool same = true, normal = true, undone = true;
    for (int trial = 0; trial < 200; ++trial) {
      Word word(random() % 40);
      for (std::uint8_t& wall : word) wall = static_cast<std::uint8_t>(random() % group.walls());
      const Word form = normal_form(automaton, word);
      same = same && group.element(form) == group.element(word);
      normal = normal && is_normal_form(automaton, form) && form.size() % 2 == word.size() % 2;
      Word back = form;
      back.insert(back.end(), word.rbegin(), word.rend());
      undone = undone && normal_form(automaton, back).empty();
    }
    CHECK(same);
    CHECK(normal);
    CHECK(undone);
  }
}

TEST_CASE("words that are no normal forms are told", "[cover]") {
  const Automaton automaton(orbifold("*22222"));
  CHECK(is_normal_form(automaton, {}));
  CHECK(is_normal_form(automaton, {0, 1, 3}));
  CHECK_FALSE(is_normal_form(automaton, {0, 0}));
  CHECK_FALSE(is_normal_form(automaton, {1, 0}));
  CHECK_FALSE(is_normal_form(automaton, {2, 0, 1}));  // 1 commutes with 0 and 2: {1, 2, 0} comes first
  CHECK_FALSE(is_normal_form(automaton, {5}));
  CHECK(normal_form(automaton, {2, 0, 1}) == Word{1, 2, 0});
}

}  // namespace
}  // namespace orbc::cover
