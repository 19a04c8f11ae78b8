#pragma once
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "compiler/cover/copy.h"
#include "compiler/cover/roots.h"
#include "compiler/notation/orbifold.h"

namespace orbc::cover {

/// ShortLex automaton of rooms whose minimal roots all belong to one corner: N ≥ 4, triangles without a right angle, two walls, one wall,
/// the strips. Computed, not stored: a state is the last wall and how many roots of its two corners are taken, counted from that wall.
/// Of each corner the first k steps of an alternating word use up its k roots one by one; a wall whose simple root is taken is barred.
class CornerAutomaton {
 public:
  struct State {
    std::int32_t last = -1;
    std::int32_t barred_left = 0,
                 barred_right =
                     0;  // for ShortLex: roots that would make the word longer or lexicographically later than another of its element
    std::int32_t turned_left = 0, turned_right = 0;  // roots that the element makes negative
  };
  explicit CornerAutomaton(const MinimalRoots& roots);

  [[nodiscard]] int walls() const { return static_cast<int>(sides_.size()); }
  [[nodiscard]] static State start() { return {}; }

  /// Whether the normal form of `state` followed by `wall` is again one.
  [[nodiscard]] bool allows(const State& state, int wall) const { return !has_root(state, wall, state.barred_left, state.barred_right); }

  /// In: allows(state, wall).
  [[nodiscard]] State next(const State& state, int wall) const {
    const Side& side = sides_[static_cast<std::size_t>(wall)];
    State after;
    after.last = wall;
    if (side.left >= 0) {
      const bool same = side.left == state.last;  // we stay in that corner, which is the right one of the last wall
      after.barred_left = same                                                                                    ? state.barred_right + 1
                          : side.left < wall || has_root(state, side.left, state.barred_left, state.barred_right) ? 2
                                                                                                                  : 1;
      after.turned_left = same ? state.turned_right + 1 : has_root(state, side.left, state.turned_left, state.turned_right) ? 2 : 1;
    }
    if (side.right >= 0) {
      const bool same = side.right == state.last;
      after.barred_right = same                                                                                      ? state.barred_left + 1
                           : side.right < wall || has_root(state, side.right, state.barred_left, state.barred_right) ? 2
                                                                                                                     : 1;
      after.turned_right = same ? state.turned_left + 1 : has_root(state, side.right, state.turned_left, state.turned_right) ? 2 : 1;
    }
    return after;
  }

  /// Bit i: wall i shortens the element (i < 64).
  [[nodiscard]] std::uint64_t descents(const State& state) const {
    if (state.last < 0) return 0;
    const Side& side = sides_[static_cast<std::size_t>(state.last)];
    std::uint64_t walls = bit(state.last);
    if (side.left >= 0 && state.turned_left == side.left_order) walls |= bit(side.left);
    if (side.right >= 0 && state.turned_right == side.right_order) walls |= bit(side.right);
    return walls;
  }

 private:
  struct Side {
    int left = -1, right = -1;  // the walls met at this wall's two corners; −1: none
    int left_order = 0, right_order = 0;
  };
  [[nodiscard]] static std::uint64_t bit(int wall) { return wall < 64 ? std::uint64_t{1} << wall : 0; }
  [[nodiscard]] bool has_root(const State& state, int wall, int left, int right) const {
    if (state.last < 0) return false;
    if (wall == state.last) return true;
    const Side& side = sides_[static_cast<std::size_t>(state.last)];
    return (wall == side.left && left == side.left_order) || (wall == side.right && right == side.right_order);
  }

  std::vector<Side> sides_;
};

/// ShortLex automaton of any room as a table: a state is a set of minimal roots. Used for triangles with a right angle, where roots of
/// three walls occur.
class TableAutomaton {
 public:
  using State = std::int32_t;

  /// Makes: all states that words of at most `max_length` walls reach.
  TableAutomaton(const MinimalRoots& roots, int max_length);

  [[nodiscard]] int walls() const { return walls_; }
  [[nodiscard]] int states() const { return static_cast<int>(descents_.size()); }
  [[nodiscard]] static State start() { return 0; }
  [[nodiscard]] bool allows(State state, int wall) const { return next(state, wall) >= 0; }
  [[nodiscard]] State next(State state, int wall) const {
    return next_[static_cast<std::size_t>(state) * static_cast<std::size_t>(walls_) + static_cast<std::size_t>(wall)];
  }
  [[nodiscard]] std::uint64_t descents(State state) const { return descents_[static_cast<std::size_t>(state)]; }

 private:
  int walls_ = 0;
  std::vector<State> next_;
  std::vector<std::uint64_t> descents_;
};

/// Lists every copy of an orbifold's room exactly once: it accepts the ShortLex normal forms of the reflection group (walls from 0, smaller
/// numbers first) and nothing else. No floating-point number decides. Immutable after construction, so threads may share it.
/// In:   a good orbifold with integer corners (at most 256); words up to `max_length`.
class Automaton {
 public:
  explicit Automaton(const notation::Orbifold& orbifold, int max_length = 1024);

  [[nodiscard]] int walls() const { return roots_.walls(); }
  [[nodiscard]] int max_length() const { return max_length_; }
  [[nodiscard]] const MinimalRoots& roots() const { return roots_; }
  [[nodiscard]] const std::variant<CornerAutomaton, TableAutomaton>& machine() const { return machine_; }

 private:
  MinimalRoots roots_;
  int max_length_;
  std::variant<CornerAutomaton, TableAutomaton> machine_;
};

/// Whether the word is the ShortLex normal form of its element. In: at most max_length walls.
[[nodiscard]] bool is_normal_form(const Automaton& automaton, const Word& word);
/// The normal form of (normal form `word`) · s_wall, in one pass over the word; its length is one more or one less.
/// Source: du Cloux, Un algorithme de forme normale pour les groupes de Coxeter (1990): one letter goes in or out.
[[nodiscard]] Word times(const Automaton& automaton, const Word& word, int wall);
/// The normal form of the element of any word, however long or redundant: two paths of a beam lead to the same copy exactly when these
/// agree.
[[nodiscard]] Word normal_form(const Automaton& automaton, const Word& word);
/// Bit i: |g·s_i| < |g| for the element g of a normal form: the copy across wall i is nearer (first 64 walls).
[[nodiscard]] std::uint64_t descents(const Automaton& automaton, const Word& word);

}  // namespace orbc::cover
