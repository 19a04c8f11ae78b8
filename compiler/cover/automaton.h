#pragma once
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "compiler/cover/copy.h"
#include "compiler/cover/roots.h"
#include "compiler/notation/orbifold.h"

namespace orbc::cover {

/// The ShortLex automaton of a room whose minimal roots all belong to one corner each: N ≥ 4, triangles without a right angle, two walls,
/// one wall, the strips. Its transitions are computed, not stored. A state is the last letter and, for each of its two corners, how many of
/// the corner's roots are used up, counted from the last wall. Each step of an alternating word of a corner of order k uses up one of its k
/// roots. A letter is forbidden when its simple root is used up.
class CornerAutomaton {
 public:
  struct State {
    std::int32_t last = -1;
    /// Roots whose letters would make the word longer than another word of its element, or lexicographically later
    std::int32_t forbidden_left = 0, forbidden_right = 0;
    /// Roots that the element makes negative
    std::int32_t negated_left = 0, negated_right = 0;
  };
  explicit CornerAutomaton(const MinimalRoots& roots);

  [[nodiscard]] int walls() const { return static_cast<int>(sides_.size()); }
  [[nodiscard]] static State start() { return {}; }

  /// Whether the normal form of `state` followed by `wall` is again one.
  [[nodiscard]] bool allows(const State& state, int wall) const {
    return !has_root(state, wall, state.forbidden_left, state.forbidden_right);
  }

  /// In: allows(state, wall).
  [[nodiscard]] State next(const State& state, int wall) const {
    const Side& side = sides_[static_cast<std::size_t>(wall)];
    State after;
    after.last = wall;
    if (side.left >= 0) {
      // The left corner of this wall is the right one of the wall before it.
      if (side.left == state.last) {
        after.forbidden_left = state.forbidden_right + 1;
        after.negated_left = state.negated_right + 1;
      } else {
        after.forbidden_left = side.left < wall || has_root(state, side.left, state.forbidden_left, state.forbidden_right) ? 2 : 1;
        after.negated_left = has_root(state, side.left, state.negated_left, state.negated_right) ? 2 : 1;
      }
    }
    if (side.right >= 0) {
      if (side.right == state.last) {
        after.forbidden_right = state.forbidden_left + 1;
        after.negated_right = state.negated_left + 1;
      } else {
        after.forbidden_right = side.right < wall || has_root(state, side.right, state.forbidden_left, state.forbidden_right) ? 2 : 1;
        after.negated_right = has_root(state, side.right, state.negated_left, state.negated_right) ? 2 : 1;
      }
    }
    return after;
  }

  /// Bit i (below 64): letter i makes the element shorter.
  [[nodiscard]] std::uint64_t descents(const State& state) const {
    if (state.last < 0) return 0;
    const Side& side = sides_[static_cast<std::size_t>(state.last)];
    std::uint64_t walls = bit(state.last);
    if (side.left >= 0 && state.negated_left == side.left_order) walls |= bit(side.left);
    if (side.right >= 0 && state.negated_right == side.right_order) walls |= bit(side.right);
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

/// The ShortLex automaton of any room as a table: a state is a set of minimal roots. Used for triangles with a right angle, which have
/// roots of three walls.
class TableAutomaton {
 public:
  using State = std::int32_t;

  /// Makes: all states that words of at most `max_length` letters reach.
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

/// Accepts the ShortLex normal forms of the reflection group of an orbifold (letters from 0, smaller letters first) and nothing else, so
/// that it lists every copy of the room exactly once. The letters are the walls that reflect. Immutable, so threads may share it.
/// In:    a good orbifold with at most 256 integer corners; words of at most `max_length` letters.
/// Exact: no floating-point number decides.
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

/// Whether a word of at most max_length letters is the ShortLex normal form of its element.
[[nodiscard]] bool is_normal_form(const Automaton& automaton, const Word& word);
/// The normal form of w · s_wall for a normal form w, in one pass over the word. One letter is inserted or removed.
/// Source: du Cloux, Un algorithme de forme normale pour les groupes de Coxeter (1990).
[[nodiscard]] Word multiply(const Automaton& automaton, const Word& word, int wall);
/// The normal form of the element of any word. Two paths lead to the same copy exactly when their normal forms are equal.
[[nodiscard]] Word normal_form(const Automaton& automaton, const Word& word);
/// Bit i (below 64): |g·s_i| < |g| for the element g of a normal form, so the copy across wall i is nearer to the room.
[[nodiscard]] std::uint64_t descents(const Automaton& automaton, const Word& word);

}  // namespace orbc::cover
