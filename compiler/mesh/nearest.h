#pragma once
#include <cstdint>
#include <vector>

#include "compiler/mesh/mesh.h"

namespace orbc::mesh {

/// Finds the distance of points from a surface: a tree of boxes over its triangles.
class Nearest {
 public:
  explicit Nearest(const Mesh& mesh);
  /// Euclidean distance from p to the nearest point of the surface; at most `known` is returned. The mesh must outlive this.
  [[nodiscard]] double distance(const geometry::Vector3& p, double known) const;
  /// The same, but satisfied with any point at most `enough` away: for who looks for the farthest of many.
  [[nodiscard]] double distance(const geometry::Vector3& p, double known, double enough) const;

 private:
  struct Node {
    geometry::Vector3 low, high;
    std::uint32_t begin, end;   // into order_
    std::uint32_t left, right;  // 0: a leaf
  };
  std::uint32_t build(std::uint32_t begin, std::uint32_t end);
  void search(std::uint32_t node, const geometry::Vector3& p, double& best, double enough) const;

  const Mesh& mesh_;
  std::vector<std::uint32_t> order_;
  std::vector<geometry::Vector3> middle_;
  std::vector<Node> nodes_;
};

}  // namespace orbc::mesh
