// Positive roots of a corner of order k, by angle: position p has the coefficients sin((k−1−p)θ)/sinθ and sin(pθ)/sinθ, θ = π/k. The
// reflection in the first wall takes p to k − p, in the second to k − 2 − p: no number is needed.
// A third wall keeps such a root minimal only in triangles, and only near the simple roots (the product with its simple root is concave in
// p). From these seeds the roots of three walls follow by rising: s·β is minimal exactly when −1 < B(β, α_s) < 0 (Brink–Howlett). Where |B|
// < 1 the two reflections generate a finite dihedral group, so B = cos(jπ/m) with m at most the largest order K: the values are 0, at least
// sin(π/2K), at most −1, or at least −cos(π/K). A bounded error much smaller than these gaps decides exactly.
#include "compiler/cover/roots.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "compiler/base/check.h"

namespace orbc::cover {
namespace {

using Real = long double;
constexpr Real kUlp = std::numeric_limits<Real>::epsilon();
constexpr Real kSeedError = 16 * kUlp;  // relative; quotient of two library sines of arguments with two roundings each
constexpr Real kMatchRadius = 1e-6;     // much larger than any error bound, much smaller than the distance of two roots of one depth

}  // namespace

MinimalRoots::MinimalRoots(const notation::Orbifold& orbifold) {
  const int corner_count = static_cast<int>(orbifold.corners.size());
  ORBC_CHECK(corner_count, <=, 256);
  walls_ = notation::is_half_strip(orbifold) ? 3 : orbifold.strip ? 2 : std::max(corner_count, 1);
  std::vector<int> orders;
  for (const Rational& corner : orbifold.corners) {
    ORBC_CHECK(static_cast<double>(denominator(corner)), ==, 1.0);
    ORBC_CHECK(static_cast<double>(corner), >=, 2.0);
    ORBC_CHECK(static_cast<double>(corner), <=, 1e6);
    orders.push_back(static_cast<int>(numerator(corner)));
  }
  ORBC_CHECK(corner_count, !=, 1);
  if (corner_count == 2) ORBC_CHECK(orders[0], ==, orders[1]);
  if (corner_count == 2 && walls_ == 2) corners_.push_back({0, 1, orders[0], 0});
  for (int i = 0; walls_ > 2 && i < corner_count; ++i)  // of the half strip: corner 1 of walls 3 and 1, corner 2 of walls 1 and 2
    corners_.push_back({(i + walls_ - 1) % walls_, i, orders[static_cast<std::size_t>(i)], 0});
  Root offset = walls_;
  for (Corner& corner : corners_) {
    corner.offset = offset;
    offset += corner.order - 2;
  }
  first_triple_ = offset;
  if (corners_.size() == 3) find_triples();
}

int MinimalRoots::corner_between(int wall, int other) const {
  if (corners_.empty() || wall == other) return -1;
  if (walls_ == 2) return 0;
  const int corner = (wall + 1) % walls_ == other ? other : (other + 1) % walls_ == wall ? wall : -1;
  return corner < static_cast<int>(corners_.size()) ? corner : -1;  // walls 2 and 3 of the half strip are parallel
}

int MinimalRoots::order(int wall, int other) const {
  const int corner = corner_between(wall, other);
  return corner < 0 ? 0 : corners_[static_cast<std::size_t>(corner)].order;
}

int MinimalRoots::corner_of(Root root) const {
  const auto after =
      std::upper_bound(corners_.begin(), corners_.end(), root, [](Root r, const Corner& corner) { return r < corner.offset; });
  // Corners of order 2 have no interior root and share their offset with the next; the last of equal ones is right.
  return static_cast<int>(after - corners_.begin()) - 1;
}

MinimalRoots::Root MinimalRoots::root_at(int corner, int position) const {
  const Corner& c = corners_[static_cast<std::size_t>(corner)];
  return position == 0 ? c.first : position == c.order - 1 ? c.second : c.offset + position - 1;
}

MinimalRoots::Root MinimalRoots::turned(int corner, int wall, int position) const {
  const Corner& c = corners_[static_cast<std::size_t>(corner)];
  const int image = wall == c.first ? c.order - position : c.order - 2 - position;
  return image < 0 || image == c.order ? kNegative : root_at(corner, image);
}

MinimalRoots::Root MinimalRoots::image(int wall, Root root) const {
  if (root < walls_) {
    if (root == wall) return kNegative;
    const int corner = corner_between(wall, root);
    if (corner < 0) return kNotMinimal;
    const Corner& c = corners_[static_cast<std::size_t>(corner)];
    return turned(corner, wall, root == c.first ? 0 : c.order - 1);
  }
  if (root >= first_triple_) return triples_[static_cast<std::size_t>(root - first_triple_)].images[static_cast<std::size_t>(wall)];
  const int corner = corner_of(root);
  const Corner& c = corners_[static_cast<std::size_t>(corner)];
  if (wall == c.first || wall == c.second) return turned(corner, wall, root - c.offset + 1);
  if (keeps(wall, c)) return root;
  const auto found = raised_.find({root, wall});
  return found == raised_.end() ? kNotMinimal : found->second;
}

bool MinimalRoots::keeps(int wall, const Corner& corner) const { return order(wall, corner.first) == 2 && order(wall, corner.second) == 2; }

/// The roots of three walls, found by depth.
class MinimalRoots::TripleFinder {
 public:
  explicit TripleFinder(MinimalRoots& roots) : roots_(roots) {
    int largest = 2;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int k = i == j ? 1 : roots.order(i, j);
        form_[index(i)][index(j)] = i == j ? 1 : k == 2 ? 0 : -std::cos(std::numbers::pi_v<Real> / k);
        largest = std::max(largest, k);
      }
    zero_gap_ = std::sin(std::numbers::pi_v<Real> / (2 * largest)) / 2;
    const Real half = std::sin(std::numbers::pi_v<Real> / (2 * largest));
    one_gap_ = half * half;  // (1 − cos(π/K))/2
  }

  void find() {
    std::map<int, std::vector<Root>> seeds = seeds_by_depth();
    const int last_seed = seeds.empty() ? 0 : seeds.rbegin()->first;
    std::vector<Root> level;
    for (int depth = 2; depth <= last_seed || !level.empty(); ++depth) {
      const std::vector<Root>& dihedral = seeds[depth];
      level.insert(level.end(), dihedral.begin(), dihedral.end());
      const std::size_t before = roots_.triples_.size();
      for (const Root root : level) rise(root, depth);
      level.clear();
      for (std::size_t i = before; i < roots_.triples_.size(); ++i) level.push_back(roots_.first_triple_ + static_cast<Root>(i));
    }
  }

 private:
  enum class Product { far, below, zero, above };  // ≤ −1, in (−1, 0), 0, positive

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  // The coefficients of any root of two or three walls, with a bound of their absolute error.
  Triple described(Root root) const {
    if (root >= roots_.first_triple_) return roots_.triples_[index(root - roots_.first_triple_)];
    const Corner& c = roots_.corners_[index(roots_.corner_of(root))];
    return dihedral(c, root - c.offset + 1);
  }

  static Triple dihedral(const Corner& c, int position) {
    const Real theta = std::numbers::pi_v<Real> / c.order;
    // The smaller of the two equal sines' arguments keeps the error relative near π.
    const auto sine = [&](int p) { return std::sin(std::min(p, c.order - p) * theta) / std::sin(theta); };
    Triple root;
    root.coefficients[index(c.first)] = sine(c.order - 1 - position);
    root.coefficients[index(c.second)] = sine(position);
    root.error = kSeedError * (root.coefficients[0] + root.coefficients[1] + root.coefficients[2]);
    root.depth = std::min(position, c.order - 1 - position) + 1;
    return root;
  }

  Real value(const Triple& root, int wall) const {
    Real sum = 0;
    for (int i = 0; i < 3; ++i) sum += form_[index(wall)][index(i)] * root.coefficients[index(i)];
    return sum;
  }

  Real value_error(const Triple& root) const {
    return 3 * root.error + 4 * kUlp * (root.coefficients[0] + root.coefficients[1] + root.coefficients[2]);
  }

  Product product(const Triple& root, int wall) const {
    ORBC_CHECK(value_error(root), <, std::min(zero_gap_, one_gap_));
    const Real b = value(root, wall);
    return b < -1 + one_gap_ ? Product::far : b < -zero_gap_ ? Product::below : b < zero_gap_ ? Product::zero : Product::above;
  }

  Triple reflected(const Triple& root, int wall) const {
    Triple image = root;
    image.coefficients[index(wall)] -= 2 * value(root, wall);
    image.error = root.error + 2 * value_error(root) + kUlp * std::abs(image.coefficients[index(wall)]);
    return image;
  }

  // The roots of corners that a third wall may raise, from both ends of each corner until the first that it does not: B is convex in
  // between.
  std::map<int, std::vector<Root>> seeds_by_depth() const {
    std::map<int, std::vector<Root>> seeds;
    for (int corner = 0; corner < 3; ++corner) {
      const Corner& c = roots_.corners_[index(corner)];
      const int third = 3 - c.first - c.second;
      if (roots_.keeps(third, c)) continue;
      const auto take = [&](int position) {
        const Triple root = dihedral(c, position);
        if (product(root, third) == Product::far) return false;
        seeds[root.depth].push_back(roots_.root_at(corner, position));
        return true;
      };
      int low = 1, high = c.order - 2;
      while (low <= high && take(low)) ++low;
      while (high > low && take(high)) --high;
    }
    return seeds;
  }

  void set_image(Root root, int wall, Root image) {
    if (root >= roots_.first_triple_) roots_.triples_[index(root - roots_.first_triple_)].images[index(wall)] = image;
    else roots_.raised_[{root, wall}] = image;
  }

  void rise(Root root, int depth) {
    const Triple described_root = described(root);
    for (int wall = 0; wall < 3; ++wall) {
      if (root < roots_.first_triple_ && described_root.coefficients[index(wall)] > 0) continue;  // inside its own corner
      const Product b = product(described_root, wall);
      if (b == Product::zero) set_image(root, wall, root);
      if (b != Product::below || roots_.image(wall, root) != kNotMinimal) continue;
      Triple raised = reflected(described_root, wall);
      raised.depth = depth + 1;
      raised.images = {kNotMinimal, kNotMinimal, kNotMinimal};
      Root id = known(raised, wall);
      if (id == kNotMinimal) {
        id = roots_.first_triple_ + static_cast<Root>(roots_.triples_.size());
        roots_.triples_.push_back(raised);
      }
      set_image(root, wall, id);
      set_image(id, wall, root);
    }
  }

  // The number of a root that was reached before by another wall t: then t lowers it to a root of the depth below, which is known to exist.
  Root known(const Triple& root, int from) const {
    for (int wall = 0; wall < 3; ++wall) {
      if (wall == from || product(root, wall) != Product::above) continue;
      const Root lower = identified(reflected(root, wall), root.depth - 1);
      const Root image = roots_.image(wall, lower);
      if (image != kNotMinimal) return image;
    }
    return kNotMinimal;
  }

  // The one root of this depth that the coefficients can mean. It exists, so being the only one within the radius identifies it.
  Root identified(const Triple& root, int depth) const {
    std::vector<Root> candidates;
    for (std::size_t i = 0; i < roots_.triples_.size(); ++i)
      if (roots_.triples_[i].depth == depth) candidates.push_back(roots_.first_triple_ + static_cast<Root>(i));
    for (int corner = 0; corner < 3; ++corner) {
      const int order = roots_.corners_[index(corner)].order;
      if (depth >= 2 && depth - 1 <= order - depth) candidates.push_back(roots_.root_at(corner, depth - 1));
      if (depth >= 2 && depth - 1 < order - depth) candidates.push_back(roots_.root_at(corner, order - depth));
    }
    ORBC_CHECK(root.error, <, kMatchRadius / 4);
    Root found = kNotMinimal;
    int matches = 0;
    for (const Root candidate : candidates) {
      const Triple other = described(candidate);
      Real gap = 0;
      for (std::size_t i = 0; i < 3; ++i) gap = std::max(gap, std::abs(other.coefficients[i] - root.coefficients[i]));
      if (gap < kMatchRadius) found = candidate, ++matches;
    }
    ORBC_CHECK(matches, ==, 1);
    return found;
  }

  MinimalRoots& roots_;
  std::array<std::array<Real, 3>, 3> form_{};
  Real zero_gap_ = 0, one_gap_ = 0;
};

void MinimalRoots::find_triples() { TripleFinder(*this).find(); }

}  // namespace orbc::cover
