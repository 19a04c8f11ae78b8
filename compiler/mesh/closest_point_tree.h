#pragma once
#include <cstdint>
#include <vector>

#include "compiler/mesh/mesh.h"

namespace orbc::mesh {

/// A tree of boxes over the triangles of a surface, which finds the distance of points from it.
class ClosestPointTree {
 public:
  explicit ClosestPointTree(const Mesh& mesh);
  /// The Euclidean distance from p to the nearest point of the surface, or `upper_bound` if that is smaller. The mesh must outlive this.
  /// The search may stop at any point at most `good_enough` away, which saves time when the farthest of many points is wanted.
  [[nodiscard]] double distance(const geometry::Vector3& p, double upper_bound, double good_enough = 0) const;

 private:
  struct Node {
    geometry::Vector3 low, high;
    std::uint32_t begin, end;   // into order_
    std::uint32_t left, right;  // 0: a leaf
  };
  std::uint32_t build(std::uint32_t begin, std::uint32_t end);
  void search(std::uint32_t node, const geometry::Vector3& p, double& best_square, double good_enough_square) const;

  const Mesh& mesh_;
  std::vector<std::uint32_t> order_;
  std::vector<geometry::Vector3> middle_;
  std::vector<Node> nodes_;
};

}  // namespace orbc::mesh
