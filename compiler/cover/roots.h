#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "compiler/notation/orbifold.h"

namespace orbc::cover {

/// The minimal roots of the reflection group of a room: the finitely many positive roots that dominate no other one. They decide whether a
/// word is a shortest one of its element, and whether it is the first of these.
/// In:     walls count from 0; the simple root of wall i has the number i; walls i−1 and i meet in corner i.
/// Exact:  roots of two walls are integers (corner, position). The few roots of all three walls of a triangle are computed with bounded
///         errors, and every decision is between values that lie further apart than the bound (checked).
/// Source: Brink, Howlett, A finiteness property and an automatic structure for Coxeter groups (1993); Casselman, Computation in Coxeter
///         groups I (2002).
class MinimalRoots {
 public:
  using Root = std::int32_t;
  static constexpr Root kNegative = -1;    ///< the image is a negative root: the root was that of the wall itself
  static constexpr Root kNotMinimal = -2;  ///< the image is positive and stays so along any reduced word

  /// In: a good orbifold with integer corners, at most 256 of them.
  explicit MinimalRoots(const notation::Orbifold& orbifold);

  [[nodiscard]] int walls() const { return walls_; }
  /// The image of a minimal root under the reflection in `wall`.
  [[nodiscard]] Root image(int wall, Root root) const;
  /// The k of the angle π/k between two walls; 0 when they do not meet (k = ∞).
  [[nodiscard]] int order(int wall, int other) const;
  /// How many minimal roots there are.
  [[nodiscard]] std::int64_t count() const {
    return static_cast<std::int64_t>(first_triangle_root_) + static_cast<std::int64_t>(triangle_roots_.size());
  }

 private:
  // A corner joins walls `first` and `second`. Its roots in the order of their angles have the positions 0 (simple root of `first`) to
  // order−1 (simple root of `second`).
  struct Corner {
    int first = 0, second = 0, order = 0;
    Root offset = 0;  // the number of the root at position 1
  };
  struct TriangleRoot {
    std::array<long double, 3> coefficients{};
    long double error = 0;
    int depth = 0;
    std::array<Root, 3> images{kNotMinimal, kNotMinimal, kNotMinimal};
  };
  class TriangleRootFinder;

  void find_triangle_roots();
  [[nodiscard]] int corner_between(int wall, int other) const;
  [[nodiscard]] bool commutes_with(int wall, const Corner& corner) const;  // it is perpendicular to both walls of the corner
  [[nodiscard]] int corner_of(Root root) const;
  [[nodiscard]] Root root_at(int corner, int position) const;
  [[nodiscard]] Root image_in_corner(int corner, int wall, int position) const;

  int walls_ = 0;
  std::vector<Corner> corners_;
  Root first_triangle_root_ = 0;
  std::vector<TriangleRoot> triangle_roots_;            // roots that involve all three walls of a triangle
  std::map<std::pair<Root, int>, Root> raised_images_;  // (root of two walls, third wall) → its image, where that is minimal
};

}  // namespace orbc::cover
