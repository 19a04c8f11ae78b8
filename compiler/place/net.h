#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "compiler/geometry/line.h"
#include "compiler/mesh/mesh.h"

namespace orbc::place {

/// A surface as convex geodesic polygons over shared vertices. Wherever two pieces touch they share the whole edge: cutting keeps that,
/// since whether and where an edge is cut follows from its two vertices alone.
struct Net {
  /// The edge from `vertex` to the next vertex of the loop; it lies on the straight line `side`. Neighbouring edges of one side are one
  /// straight border.
  struct Edge {
    std::uint32_t vertex = 0;
    int side = 0;
  };
  struct Piece {
    std::vector<Edge> loop;
    int tag = 0;                    ///< free for the maker: which cell, which colour
  };
  std::vector<geometry::Position> vertices;
  std::vector<Piece> pieces;
};

/// The pieces of a net left (and on) and right of a cut.
struct Halves {
  std::vector<Net::Piece> left, right;
};

/// Cuts pieces where a function of their vertices changes sign: left is where it is ≥ 0. `make(a, b, t)` makes the vertex at (1−t)·a + t·b,
/// once for each edge, a < b.
[[nodiscard]] Halves cut_by(const std::vector<Net::Piece>& pieces, int side, const std::function<double(std::uint32_t)>& value,
                            const std::function<std::uint32_t(std::uint32_t, std::uint32_t, double)>& make);

/// Cuts pieces of `net` along a line (all heights); new vertices go to the net, new edges get the side `side`.
/// In:    pieces of net.vertices; sides of old edges differ from `side`. All pieces that share edges must come in one call.
/// Error: a vertex within 1e-12 (relative to its coordinates) of the line counts as on it, so that lines through a corner leave no slivers.
[[nodiscard]] Halves cut(geometry::Space space, Net& net, const std::vector<Net::Piece>& pieces, const geometry::Line& line, int side);
/// The same along the height z: left is above.
[[nodiscard]] Halves cut_at_height(geometry::Space space, Net& net, const std::vector<Net::Piece>& pieces, double z, int side);

/// The triangles of a piece, turning as its loop does, none degenerate, every vertex of the loop used; adds a hub in the middle to
/// net.vertices when no fan from a vertex does it. In: no two vertices of the piece are antipodal; at least three sides.
[[nodiscard]] std::vector<mesh::Triangle> triangulate(geometry::Space space, Net& net, const Net::Piece& piece);
/// The fan from a given vertex inside the piece.
[[nodiscard]] std::vector<mesh::Triangle> fan(const Net::Piece& piece, std::uint32_t hub);

}  // namespace orbc::place
