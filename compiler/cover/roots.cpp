// The positive roots of a corner of order k, in the order of their angles: position p has the coefficients sin((k−1−p)θ)/sinθ and
// sin(pθ)/sinθ with θ = π/k. The reflection in the first wall maps p to k − p, the reflection in the second to k − 2 − p.
//
// The image of such a root under a third wall is minimal only in triangles, and only near the simple roots (the product with the simple
// root of the third wall is concave in p). From these seeds the roots of three walls follow by increasing depth: s·β is minimal exactly
// when −1 < B(β, α_s) < 0 (Brink–Howlett). Where |B| < 1 the two reflections generate a finite dihedral group, so B = cos(jπ/m) with m at
// most the largest order K. So B is 0, or at least sin(π/2K) in size, and it is at most −1 or at least −cos(π/K). An error that is much
// smaller than these gaps decides exactly.
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
constexpr Real kSeedError = 16 * kUlp;  // relative: a quotient of two library sines, whose arguments have two roundings each
constexpr Real kMatchRadius = 1e-6;     // far above any error bound, far below the distance of two roots of one depth

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
  first_triangle_root_ = offset;
  if (corners_.size() == 3) find_triangle_roots();
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

MinimalRoots::Root MinimalRoots::image_in_corner(int corner, int wall, int position) const {
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
    return image_in_corner(corner, wall, root == c.first ? 0 : c.order - 1);
  }
  if (root >= first_triangle_root_)
    return triangle_roots_[static_cast<std::size_t>(root - first_triangle_root_)].images[static_cast<std::size_t>(wall)];
  const int corner = corner_of(root);
  const Corner& c = corners_[static_cast<std::size_t>(corner)];
  if (wall == c.first || wall == c.second) return image_in_corner(corner, wall, root - c.offset + 1);
  if (commutes_with(wall, c)) return root;
  const auto found = raised_images_.find({root, wall});
  return found == raised_images_.end() ? kNotMinimal : found->second;
}

bool MinimalRoots::commutes_with(int wall, const Corner& corner) const {
  return order(wall, corner.first) == 2 && order(wall, corner.second) == 2;
}

/// Finds the roots of three walls by depth.
class MinimalRoots::TriangleRootFinder {
 public:
  explicit TriangleRootFinder(MinimalRoots& roots) : roots_(roots) {
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
      const std::size_t before = roots_.triangle_roots_.size();
      for (const Root root : level) rise(root, depth);
      level.clear();
      for (std::size_t i = before; i < roots_.triangle_roots_.size(); ++i)
        level.push_back(roots_.first_triangle_root_ + static_cast<Root>(i));
    }
  }

 private:
  enum class Product { far, below, zero, above };  // ≤ −1, in (−1, 0), 0, positive

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  // The coefficients of a root of two or three walls, with a bound of their absolute error.
  TriangleRoot expanded(Root root) const {
    if (root >= roots_.first_triangle_root_) return roots_.triangle_roots_[index(root - roots_.first_triangle_root_)];
    const Corner& c = roots_.corners_[index(roots_.corner_of(root))];
    return dihedral(c, root - c.offset + 1);
  }

  static TriangleRoot dihedral(const Corner& c, int position) {
    const Real theta = std::numbers::pi_v<Real> / c.order;
    // Of the two arguments with equal sines, the smaller one has the smaller relative error.
    const auto sine = [&](int p) { return std::sin(std::min(p, c.order - p) * theta) / std::sin(theta); };
    TriangleRoot root;
    root.coefficients[index(c.first)] = sine(c.order - 1 - position);
    root.coefficients[index(c.second)] = sine(position);
    root.error = kSeedError * (root.coefficients[0] + root.coefficients[1] + root.coefficients[2]);
    root.depth = std::min(position, c.order - 1 - position) + 1;
    return root;
  }

  Real value(const TriangleRoot& root, int wall) const {
    Real sum = 0;
    for (int i = 0; i < 3; ++i) sum += form_[index(wall)][index(i)] * root.coefficients[index(i)];
    return sum;
  }

  Real value_error(const TriangleRoot& root) const {
    return 3 * root.error + 4 * kUlp * (root.coefficients[0] + root.coefficients[1] + root.coefficients[2]);
  }

  Product product(const TriangleRoot& root, int wall) const {
    ORBC_CHECK(value_error(root), <, std::min(zero_gap_, one_gap_));
    const Real b = value(root, wall);
    return b < -1 + one_gap_ ? Product::far : b < -zero_gap_ ? Product::below : b < zero_gap_ ? Product::zero : Product::above;
  }

  TriangleRoot reflected(const TriangleRoot& root, int wall) const {
    TriangleRoot image = root;
    image.coefficients[index(wall)] -= 2 * value(root, wall);
    image.error = root.error + 2 * value_error(root) + kUlp * std::abs(image.coefficients[index(wall)]);
    return image;
  }

  // The roots of corners whose images under the third wall may be minimal: from both ends of each corner up to the first whose image is
  // not. B is convex between them.
  std::map<int, std::vector<Root>> seeds_by_depth() const {
    std::map<int, std::vector<Root>> seeds;
    for (int corner = 0; corner < 3; ++corner) {
      const Corner& c = roots_.corners_[index(corner)];
      const int third = 3 - c.first - c.second;
      if (roots_.commutes_with(third, c)) continue;
      const auto take = [&](int position) {
        const TriangleRoot root = dihedral(c, position);
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
    if (root >= roots_.first_triangle_root_) roots_.triangle_roots_[index(root - roots_.first_triangle_root_)].images[index(wall)] = image;
    else roots_.raised_images_[{root, wall}] = image;
  }

  void rise(Root root, int depth) {
    const TriangleRoot expanded_root = expanded(root);
    for (int wall = 0; wall < 3; ++wall) {
      if (root < roots_.first_triangle_root_ && expanded_root.coefficients[index(wall)] > 0) continue;  // inside its own corner
      const Product b = product(expanded_root, wall);
      if (b == Product::zero) set_image(root, wall, root);
      if (b != Product::below || roots_.image(wall, root) != kNotMinimal) continue;
      TriangleRoot raised = reflected(expanded_root, wall);
      raised.depth = depth + 1;
      raised.images = {kNotMinimal, kNotMinimal, kNotMinimal};
      Root id = find_known(raised, wall);
      if (id == kNotMinimal) {
        id = roots_.first_triangle_root_ + static_cast<Root>(roots_.triangle_roots_.size());
        roots_.triangle_roots_.push_back(raised);
      }
      set_image(root, wall, id);
      set_image(id, wall, root);
    }
  }

  // The number of a root that was found before by another wall t. Then the reflection in t maps it to a root of the depth below, which
  // exists already. kNotMinimal when the root is new.
  Root find_known(const TriangleRoot& root, int from) const {
    for (int wall = 0; wall < 3; ++wall) {
      if (wall == from || product(root, wall) != Product::above) continue;
      const Root lower = find_equal(reflected(root, wall), root.depth - 1);
      const Root image = roots_.image(wall, lower);
      if (image != kNotMinimal) return image;
    }
    return kNotMinimal;
  }

  // The one root of this depth that has these coefficients. It exists, so the only root within the radius is it.
  Root find_equal(const TriangleRoot& root, int depth) const {
    std::vector<Root> candidates;
    for (std::size_t i = 0; i < roots_.triangle_roots_.size(); ++i)
      if (roots_.triangle_roots_[i].depth == depth) candidates.push_back(roots_.first_triangle_root_ + static_cast<Root>(i));
    for (int corner = 0; corner < 3; ++corner) {
      const int order = roots_.corners_[index(corner)].order;
      if (depth >= 2 && depth - 1 <= order - depth) candidates.push_back(roots_.root_at(corner, depth - 1));
      if (depth >= 2 && depth - 1 < order - depth) candidates.push_back(roots_.root_at(corner, order - depth));
    }
    ORBC_CHECK(root.error, <, kMatchRadius / 4);
    Root found = kNotMinimal;
    int matches = 0;
    for (const Root candidate : candidates) {
      const TriangleRoot other = expanded(candidate);
      Real gap = 0;
      for (std::size_t i = 0; i < 3; ++i) gap = std::max(gap, std::abs(other.coefficients[i] - root.coefficients[i]));
      if (gap < kMatchRadius) {
        found = candidate;
        ++matches;
      }
    }
    ORBC_CHECK(matches, ==, 1);
    return found;
  }

  MinimalRoots& roots_;
  std::array<std::array<Real, 3>, 3> form_{};
  Real zero_gap_ = 0, one_gap_ = 0;
};

void MinimalRoots::find_triangle_roots() { TriangleRootFinder(*this).find(); }

}  // namespace orbc::cover
