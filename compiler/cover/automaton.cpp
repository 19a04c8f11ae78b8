// A reduced word w stays reduced when s is appended exactly if α_s is none of the positive roots that w makes negative; only minimal roots
// matter here. Appending s maps this set T to {α_s} ∪ sT. ShortLex forbids also s·α_t for t < s: if a later letter used it up, the word
// could have t in place of s (Brink–Howlett 1993; Casselman 2002).
#include "compiler/cover/automaton.h"

#include <algorithm>
#include <map>

#include "compiler/base/check.h"

namespace orbc::cover {
namespace {

using Root = MinimalRoots::Root;
using Roots = std::vector<Root>;  // ascending

// Roots of one corner form few runs of successive numbers, so sets of roots are stored as runs: [first, last, first, last, …].
Roots runs_of(const Roots& roots) {
  Roots runs;
  for (const Root root : roots) {
    if (!runs.empty() && runs.back() + 1 == root) runs.back() = root;
    else runs.insert(runs.end(), {root, root});
  }
  return runs;
}

Roots roots_of(const Roots& runs) {
  Roots roots;
  for (std::size_t i = 0; i < runs.size(); i += 2)
    for (Root root = runs[i]; root <= runs[i + 1]; ++root) roots.push_back(root);
  return roots;
}

Roots image_of(const MinimalRoots& roots, int wall, const Roots& runs, bool forbid_smaller) {
  Roots image{wall};
  const auto add = [&](Root root) {
    const Root r = roots.image(wall, root);
    if (r >= 0) image.push_back(r);
  };
  for (const Root root : roots_of(runs)) add(root);
  for (Root smaller = 0; forbid_smaller && smaller < wall; ++smaller) add(smaller);
  std::sort(image.begin(), image.end());
  image.erase(std::unique(image.begin(), image.end()), image.end());
  return runs_of(image);
}

bool contains(const Roots& runs, Root root) {
  for (std::size_t i = 0; i < runs.size(); i += 2)
    if (runs[i] <= root && root <= runs[i + 1]) return true;
  return false;
}

std::uint64_t simple_bits(const Roots& runs, int walls) {
  std::uint64_t bits = 0;
  for (int wall = 0; wall < std::min(walls, 64); ++wall)
    if (contains(runs, wall)) bits |= std::uint64_t{1} << wall;
  return bits;
}

// Whether a right angle allows minimal roots that involve all three walls of a triangle.
bool needs_table(const MinimalRoots& roots) {
  if (roots.walls() != 3 || roots.order(1, 2) == 0) return false;
  return roots.order(0, 1) == 2 || roots.order(1, 2) == 2 || roots.order(0, 2) == 2;
}

std::variant<CornerAutomaton, TableAutomaton> machine_for(const MinimalRoots& roots, int max_length) {
  if (needs_table(roots)) return TableAutomaton(roots, max_length);
  return CornerAutomaton(roots);
}

}  // namespace

CornerAutomaton::CornerAutomaton(const MinimalRoots& roots) : sides_(static_cast<std::size_t>(roots.walls())) {
  const int walls = roots.walls();
  for (int wall = 0; wall + 1 < walls || (walls > 2 && wall < walls); ++wall) {
    const int next = (wall + 1) % walls;
    const int order = roots.order(wall, next);
    if (order == 0) continue;
    Side& here = sides_[static_cast<std::size_t>(wall)];
    Side& there = sides_[static_cast<std::size_t>(next)];
    here.right = next;
    here.right_order = order;
    there.left = wall;
    there.left_order = order;
  }
}

TableAutomaton::TableAutomaton(const MinimalRoots& roots, int max_length) : walls_(roots.walls()) {
  struct Sets {
    Roots forbidden, negated;  // as runs
    bool operator<(const Sets& other) const { return forbidden != other.forbidden ? forbidden < other.forbidden : negated < other.negated; }
  };
  std::map<Sets, State> numbers{{Sets{}, 0}};
  std::vector<Sets> level{Sets{}};  // the states of one length, in the order of their numbers
  descents_.push_back(0);
  for (int length = 0; length < max_length && !level.empty(); ++length) {
    std::vector<Sets> following;
    for (const Sets& state : level) {
      for (int wall = 0; wall < walls_; ++wall) {
        if (contains(state.forbidden, wall)) {
          next_.push_back(-1);
          continue;
        }
        Sets after{image_of(roots, wall, state.forbidden, true), image_of(roots, wall, state.negated, false)};
        const auto [at, is_new] = numbers.insert({after, static_cast<State>(descents_.size())});
        next_.push_back(at->second);
        if (!is_new) continue;
        descents_.push_back(simple_bits(after.negated, walls_));
        following.push_back(std::move(after));
      }
    }
    level = std::move(following);
  }
  // States that only words of the full length reach have no transitions.
  next_.resize(descents_.size() * static_cast<std::size_t>(walls_), -1);
}

Automaton::Automaton(const notation::Orbifold& orbifold, int max_length)
    : roots_(orbifold), max_length_(max_length), machine_(machine_for(roots_, max_length)) {}

bool is_normal_form(const Automaton& automaton, const Word& word) {
  ORBC_CHECK(static_cast<int>(word.size()), <=, automaton.max_length());
  return std::visit(
      [&](const auto& machine) {
        auto state = machine.start();
        for (const std::uint8_t wall : word) {
          if (wall >= machine.walls() || !machine.allows(state, wall)) return false;
          state = machine.next(state, wall);
        }
        return true;
      },
      automaton.machine());
}

Word multiply(const Automaton& automaton, const Word& word, int wall) {
  // Going back through the word, `root` is the image of the simple root of `wall` under the letters passed. Where it is a simple root, its
  // letter may be inserted there instead.
  const MinimalRoots& roots = automaton.roots();
  Root root = wall;
  std::size_t best = word.size();
  int letter = wall;
  for (std::size_t i = word.size(); i-- > 0 && root >= 0;) {
    if (root == word[i]) {
      Word shorter = word;
      shorter.erase(shorter.begin() + static_cast<std::ptrdiff_t>(i));
      return shorter;
    }
    root = roots.image(word[i], root);
    if (root >= 0 && root < roots.walls() && root < word[i]) {
      best = i;
      letter = root;
    }
  }
  Word longer = word;
  longer.insert(longer.begin() + static_cast<std::ptrdiff_t>(best), static_cast<std::uint8_t>(letter));
  return longer;
}

Word normal_form(const Automaton& automaton, const Word& word) {
  Word result;
  for (const std::uint8_t wall : word) result = multiply(automaton, result, wall);
  return result;
}

std::uint64_t descents(const Automaton& automaton, const Word& word) {
  ORBC_CHECK(static_cast<int>(word.size()), <=, automaton.max_length());
  return std::visit(
      [&](const auto& machine) {
        auto state = machine.start();
        for (const std::uint8_t wall : word) state = machine.next(state, wall);
        return machine.descents(state);
      },
      automaton.machine());
}

}  // namespace orbc::cover
