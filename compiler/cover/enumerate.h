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

/// What the stream does after a visit. A visitor may also return bool: true = deeper, false = back.
enum class Walk {
  deeper,  ///< go on to the words that begin with this one
  back,    ///< leave them out
  stop     ///< end the stream
};

/// The element on which the stream stands, by its normal form. Valid during the visit only.
struct Element {
  std::span<const std::uint8_t> word;  ///< walls from 0
  std::uint64_t descents = 0;          ///< bit i: |g·s_i| < |g|, the copy across wall i is nearer (Copy::nearer_walls of even sheets)
};

namespace detail {

inline Walk walk_of(Walk walk) { return walk; }
inline Walk walk_of(bool deeper) { return deeper ? Walk::deeper : Walk::back; }

// Depth first, smaller walls first, without recursion: memory is one state per letter of the longest word.
// `enter(depth, wall)` is told of every step before `visit(element)` sees it.
template <class Machine, class Enter, class Visit>
bool walk(const Machine& machine, int max_length, Enter&& enter, Visit&& visit) {
  using State = typename Machine::State;
  const int walls = machine.walls();
  std::vector<State> states{Machine::start()};
  std::vector<std::uint8_t> word;
  std::vector<int> untried{0};
  switch (walk_of(visit(Element{}))) {
    case Walk::deeper:
      break;
    case Walk::back:
      return true;
    case Walk::stop:
      return false;
  }
  if (max_length <= 0) return true;
  for (;;) {
    const State state = states.back();
    int wall = untried.back();
    while (wall < walls && !machine.allows(state, wall)) ++wall;
    if (wall == walls) {
      if (word.empty()) return true;
      states.pop_back(), untried.pop_back(), word.pop_back();
      continue;
    }
    untried.back() = wall + 1;
    const State next = machine.next(state, wall);
    word.push_back(static_cast<std::uint8_t>(wall));
    enter(word.size(), wall);
    const Walk walk = walk_of(visit(Element{std::span<const std::uint8_t>(word), machine.descents(next)}));
    if (walk == Walk::stop) return false;
    if (walk == Walk::back || static_cast<int>(word.size()) == max_length) {
      word.pop_back();
      continue;
    }
    states.push_back(next), untried.push_back(0);
  }
}

}  // namespace detail

/// Visits every element of the reflection group whose word has at most `max_length` (≤ automaton.max_length()) walls, each exactly once,
/// words before their continuations, smaller walls first. visit(const Element&) → Walk or bool. Makes:  false when the visitor stopped the
/// stream. Memory: a few bytes per letter of the longest word, whatever the count.
template <class Visitor>
bool enumerate(const Automaton& automaton, int max_length, Visitor&& visit) {
  ORBC_CHECK(max_length, <=, automaton.max_length());
  return std::visit(
      [&](const auto& machine) {
        return detail::walk(
            machine, max_length, [](std::size_t, int) {}, visit);
      },
      automaton.machine());
}

/// The same with the isometry of each copy: visit(const Element&, const geometry::Isometry& cover_from_room) → Walk or bool.
/// In:    reflections[i] = room::reflection_in_wall(room, i), one for each wall of the automaton.
/// Makes: cover_from_room = s_{word[0]} · s_{word[1]} · …, renormalised on the way; its prefix products are computed once.
template <class Visitor>
bool enumerate(const Automaton& automaton, const std::vector<geometry::Isometry>& reflections, int max_length, Visitor&& visit) {
  ORBC_CHECK(static_cast<int>(reflections.size()), ==, automaton.walls());
  ORBC_CHECK(max_length, <=, automaton.max_length());
  std::vector<geometry::Isometry> products{geometry::identity(reflections.front().space)};
  const auto enter = [&](std::size_t depth, int wall) {
    products.resize(depth);
    const geometry::Isometry product = products.back() * reflections[static_cast<std::size_t>(wall)];
    products.push_back(depth % 8 == 0 ? geometry::renormalised(product) : product);
  };
  const auto visit_copy = [&](const Element& element) { return visit(element, std::as_const(products[element.word.size()])); };
  return std::visit([&](const auto& machine) { return detail::walk(machine, max_length, enter, visit_copy); }, automaton.machine());
}

}  // namespace orbc::cover
