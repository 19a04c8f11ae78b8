// Corner lists up to rotation are necklaces; they are listed lexicographically with constant memory by the recursion of Fredricksen,
// Kessler and Maiorana (Ruskey, Savage, Wang, Generating necklaces, 1992). Those that are also smallest among their reflections are kept.
#include "compiler/notation/enumerate.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "compiler/notation/classify.h"
#include "compiler/notation/parse.h"

namespace orbc::notation {
namespace {

using geometry::Space;

class Necklaces {
 public:
  Necklaces(int corners, int max_order, const OrbifoldVisitor& visit)
      : orders_(static_cast<std::size_t>(corners) + 1, 2),
        corners_(static_cast<std::size_t>(corners)),
        max_order_(max_order),
        visit_(visit) {}

  // Visits the hyperbolic ones in lexicographic order; false when the visitor ended it.
  bool run() { return extend(1, 1); }

 private:
  // orders_[1 … at−1] is a prefix of a necklace whose longest Lyndon prefix has length `period`.
  bool extend(std::size_t at, std::size_t period) {
    if (at > corners_) return corners_ % period != 0 || !is_smallest_reflection() || tell();
    orders_[at] = at > period ? orders_[at - period] : 2;
    if (!extend(at + 1, period)) return false;
    while (orders_[at] < max_order_) {
      ++orders_[at];
      if (!extend(at + 1, at)) return false;
    }
    return true;
  }

  bool is_smallest_reflection() const {
    for (std::size_t start = 1; start <= corners_; ++start) {
      for (std::size_t i = 1, j = start; i <= corners_; ++i, j = j == 1 ? corners_ : j - 1) {
        if (orders_[j] > orders_[i]) break;
        if (orders_[j] < orders_[i]) return false;
      }
    }
    return true;
  }

  bool tell() {
    Orbifold orbifold;
    orbifold.corners.assign(orders_.begin() + 1, orders_.end());
    // From five corners on χ ≤ 1 − 5/4 < 0.
    if (corners_ <= 4 && classify(orbifold).value() != Space::hyperbolic) return true;
    return visit_(orbifold, Space::hyperbolic);
  }

  std::vector<int> orders_;  // from 1
  std::size_t corners_;
  int max_order_;
  const OrbifoldVisitor& visit_;
};

// All orbifolds of S² and E² in the order of the list; the families in k are cut off at max_order.
std::vector<std::vector<int>> not_hyperbolic(int corners, int max_order, Space space) {
  std::vector<std::vector<int>> lists;
  const bool sphere = space == Space::spherical;
  if (corners == 1 && sphere) lists.push_back({});
  for (int k = 2; sphere && corners == 2 && k <= max_order; ++k) lists.push_back({k, k});
  for (int k = 2; sphere && corners == 3 && k <= max_order; ++k) lists.push_back({2, 2, k});
  if (corners == 3 && sphere) lists.insert(lists.end(), {{2, 3, 3}, {2, 3, 4}, {2, 3, 5}});
  if (corners == 3 && !sphere) lists.insert(lists.end(), {{2, 3, 6}, {2, 4, 4}, {3, 3, 3}});
  if (corners == 4 && !sphere) lists.push_back({2, 2, 2, 2});
  const auto too_large = [&](const std::vector<int>& list) {
    return !list.empty() && *std::max_element(list.begin(), list.end()) > max_order;
  };
  lists.erase(std::remove_if(lists.begin(), lists.end(), too_large), lists.end());
  return lists;
}

Diagnostics range_errors(int corners, int max_order) {
  Diagnostics errors;
  if (corners < 1 || corners > kMaxCorners)
    errors.push_back(make_error("notation.enumerate-out-of-range", fmt::format("orbifolds with {} corners cannot be listed", corners),
                                fmt::format("1 to {} corners", kMaxCorners)));
  if (max_order < 2 || max_order > kMaxOrder)
    errors.push_back(make_error("notation.enumerate-out-of-range", fmt::format("{} is no largest order of corners", max_order),
                                fmt::format("2 to {}", kMaxOrder)));
  return errors;
}

Integer power(const Integer& base, int exponent) { return pow(base, static_cast<unsigned>(exponent)); }

}  // namespace

Result<bool> enumerate(int corners, int max_order, const OrbifoldVisitor& visit) {
  if (Diagnostics errors = range_errors(corners, max_order); !errors.empty()) return errors;
  for (const Space space : {Space::spherical, Space::euclidean}) {
    for (const std::vector<int>& list : not_hyperbolic(corners, max_order, space)) {
      Orbifold orbifold;
      orbifold.corners.assign(list.begin(), list.end());
      if (!visit(orbifold, space)) return false;
    }
  }
  if (corners < 3) return true;
  return Necklaces(corners, max_order, visit).run();
}

Result<Integer> count_orbifolds(int corners, int max_order, std::optional<Space> space) {
  if (Diagnostics errors = range_errors(corners, max_order); !errors.empty()) return errors;
  if (space == Space::hyperbolic) {
    Integer rest = *count_orbifolds(corners, max_order);
    for (const Space other : {Space::spherical, Space::euclidean}) rest -= Integer(not_hyperbolic(corners, max_order, other).size());
    return rest;
  }
  if (space) return Integer(not_hyperbolic(corners, max_order, *space).size());
  if (corners == 1) return Integer(1);
  const Integer letters = max_order - 1;
  if (corners == 2) return letters;
  Integer fixed = 0;
  for (int turn = 0; turn < corners; ++turn) fixed += power(letters, std::gcd(turn, corners));
  const int half = corners / 2;
  if (corners % 2 == 1) fixed += corners * power(letters, half + 1);
  else fixed += half * (power(letters, half) + power(letters, half + 1));
  return Integer(fixed / (2 * corners));
}

}  // namespace orbc::notation
