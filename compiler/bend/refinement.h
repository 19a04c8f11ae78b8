#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "compiler/bend/torn_map.h"

namespace orbc::bend {

/// An edge between two corners. When it is split, its halves are the edges first_half (from a to the midpoint) and first_half + 1.
struct Edge {
  struct Split {
    std::uint32_t midpoint = 0, first_half = 0;
  };
  std::uint32_t a = 0, b = 0;
  std::optional<Split> split;
  bool far_within_tolerance = false;  ///< EdgeVerdict
};

/// A triangle: edge k joins corners k and k + 1.
struct Face {
  std::array<std::uint32_t, 3> corners{}, edges{};
};
/// The same face, beginning with its second corner.
[[nodiscard]] Face rotated(const Face& face);

/// The corners, edges and finished triangles of a tessellation that grows. Invariant: nothing is removed, so that indices stay valid; above
/// the limit of triangles `is_full` stays true.
class Refinement {
 public:
  explicit Refinement(std::uint64_t max_triangles) : max_triangles_(max_triangles) {}

  /// Begins with the corners and edges of a part.
  void begin(std::vector<Corner> corners, const std::vector<std::array<std::uint32_t, 2>>& edges);
  std::uint32_t add_corner(const Corner& corner);
  std::uint32_t add_edge(std::uint32_t a, std::uint32_t b);
  /// Splits an edge at a corner. Makes: the index of its first half.
  std::uint32_t split_edge(std::uint32_t edge, std::uint32_t midpoint);
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);

  [[nodiscard]] bool is_full() const { return is_full_; }
  [[nodiscard]] const Corner& corner(std::uint32_t i) const { return corners_[i]; }
  [[nodiscard]] const std::vector<Corner>& corners() const { return corners_; }
  [[nodiscard]] std::vector<mesh::Triangle> take_triangles() { return std::move(triangles_); }
  [[nodiscard]] const Edge& edge(std::uint32_t i) const { return edges_[i]; }
  [[nodiscard]] Edge& edge(std::uint32_t i) { return edges_[i]; }
  /// Of an edge whose one end lies on an axis: the vertex on the circle that stands for this end. Nothing until it is set.
  [[nodiscard]] std::optional<std::uint32_t> circle_vertex(std::uint32_t edge) const;
  void set_circle_vertex(std::uint32_t edge, std::uint32_t vertex) { circle_vertices_[edge] = vertex; }
  /// The half of a split edge at one of its ends.
  [[nodiscard]] std::uint32_t half(std::uint32_t edge, std::uint32_t end) const;
  [[nodiscard]] std::uint32_t midpoint(std::uint32_t edge) const { return edges_[edge].split->midpoint; }
  /// The squared distance of two corners in room coordinates, in the ambient space.
  [[nodiscard]] double squared_distance(std::uint32_t a, std::uint32_t b) const;

 private:
  std::uint64_t max_triangles_;
  bool is_full_ = false;
  std::vector<Corner> corners_;
  std::vector<Edge> edges_;
  std::map<std::uint32_t, std::uint32_t> circle_vertices_;  // by edge; few edges have one
  std::vector<mesh::Triangle> triangles_;
};

/// Draws a face of which one or more corners lie on an axis. Such a corner has no image of its own but one for every direction: the cone
/// (A, B, axis) becomes the quad A B B' A' whose side A'B' is a piece of the circle.
void add_face_at_axis(Refinement& refinement, const TornMap& map, const Face& face);

}  // namespace orbc::bend
