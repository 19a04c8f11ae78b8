#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "compiler/base/check.h"
#include "compiler/cover/automaton.h"
#include "compiler/geometry/isometry.h"

namespace orbc::cover {

/// How a depth-first enumeration continues after a visit. A visitor may also return bool: true = descend, false = prune.
enum class Visit {
  descend,  ///< continue with the words that begin with this one
  prune,    ///< leave these words out
  stop      ///< end the enumeration
};

/// A group element by its normal form. Valid during its visit only.
struct Element {
  std::span<const std::uint8_t> word;  ///< letters of the automaton, from 0
  std::uint64_t descents = 0;          ///< bit i: |g·s_i| < |g|, so the copy across wall i is nearer to the room
};

namespace detail {

inline Visit visit_of(Visit visit) { return visit; }
inline Visit visit_of(bool descend) { return descend ? Visit::descend : Visit::prune; }

// Depth first, smaller letters first, without recursion: one state per letter of the longest word is kept.
// `enter(depth, letter)` is called before `visit(element)`.
template <class Machine, class Enter, class Visitor>
bool visit_words(const Machine& machine, int max_length, Enter&& enter, Visitor&& visit) {
  using State = typename Machine::State;
  const int letters = machine.walls();
  std::vector<State> states{Machine::start()};
  std::vector<std::uint8_t> word;
  std::vector<int> untried{0};
  const Visit first = visit_of(visit(Element{}));
  if (first != Visit::descend) return first == Visit::prune;
  if (max_length <= 0) return true;
  for (;;) {
    const State state = states.back();
    int letter = untried.back();
    while (letter < letters && !machine.allows(state, letter)) ++letter;
    if (letter == letters) {
      if (word.empty()) return true;
      states.pop_back();
      untried.pop_back();
      word.pop_back();
      continue;
    }
    untried.back() = letter + 1;
    const State next = machine.next(state, letter);
    word.push_back(static_cast<std::uint8_t>(letter));
    enter(word.size(), letter);
    const Visit then = visit_of(visit(Element{std::span<const std::uint8_t>(word), machine.descents(next)}));
    if (then == Visit::stop) return false;
    if (then == Visit::prune || static_cast<int>(word.size()) == max_length) {
      word.pop_back();
      continue;
    }
    states.push_back(next);
    untried.push_back(0);
  }
}

}  // namespace detail

/// Visits every element of the reflection group whose word has at most `max_length` letters, each exactly once: words before their
/// continuations, smaller letters first.
/// In:     max_length ≤ automaton.max_length(); visit(const Element&) → Visit or bool.
/// Makes:  false when the visitor stopped the enumeration.
/// Memory: a few bytes per letter of the longest word, whatever the number of elements.
template <class Visitor>
bool enumerate(const Automaton& automaton, int max_length, Visitor&& visit) {
  ORBC_CHECK(max_length, <=, automaton.max_length());
  const auto enter = [](std::size_t, int) {};
  return std::visit([&](const auto& machine) { return detail::visit_words(machine, max_length, enter, visit); }, automaton.machine());
}

/// The same with the isometry of each copy: visit(const Element&, const geometry::Isometry& cover_from_room) → Visit or bool.
/// In:    reflections[i] = the reflection of letter i, for every letter of the automaton.
/// Makes: cover_from_room = s_{word[0]} · s_{word[1]} · …, renormalised after every eighth factor. Products of prefixes are computed once.
template <class Visitor>
bool enumerate(const Automaton& automaton, const std::vector<geometry::Isometry>& reflections, int max_length, Visitor&& visit) {
  ORBC_CHECK(static_cast<int>(reflections.size()), ==, automaton.walls());
  ORBC_CHECK(max_length, <=, automaton.max_length());
  std::vector<geometry::Isometry> products{geometry::identity(reflections.front().space)};
  const auto enter = [&](std::size_t depth, int letter) {
    products.resize(depth);
    const geometry::Isometry product = products.back() * reflections[static_cast<std::size_t>(letter)];
    products.push_back(depth % 8 == 0 ? geometry::renormalised(product) : product);
  };
  const auto visit_copy = [&](const Element& element) { return visit(element, std::as_const(products[element.word.size()])); };
  return std::visit([&](const auto& machine) { return detail::visit_words(machine, max_length, enter, visit_copy); }, automaton.machine());
}

}  // namespace orbc::cover
