#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "compiler/geometry/line.h"
#include "compiler/mesh/mesh.h"

namespace orbc::place {

/// A surface of convex geodesic polygons over shared vertices. Polygons that touch share whole edges. Splitting preserves that, because
/// whether and where an edge is split depends on its two vertices alone.
struct PolygonMesh {
  /// The edge from `vertex` to the next vertex of the loop. It lies on the straight line with the number `side`; consecutive edges with the
  /// same side are collinear.
  struct Edge {
    std::uint32_t vertex = 0;
    int side = 0;
  };
  struct Polygon {
    std::vector<Edge> loop;         ///< counter-clockwise or clockwise, as the maker likes
    int label = 0;                  ///< free for the maker: the cell or the colour
  };
  std::vector<geometry::Position> vertices;
  std::vector<Polygon> polygons;
};

/// The polygons to the left of a line (and on it), and to its right.
struct SplitResult {
  std::vector<PolygonMesh::Polygon> left, right;
};

/// Splits polygons where a function of their vertices changes its sign; the left part is where it is ≥ 0.
/// In: `make(a, b, t)` makes the vertex at (1−t)·a + t·b and returns its index. It is called once per split edge, with a < b.
[[nodiscard]] SplitResult split_by(const std::vector<PolygonMesh::Polygon>& polygons, int side,
                                   const std::function<double(std::uint32_t)>& value,
                                   const std::function<std::uint32_t(std::uint32_t, std::uint32_t, double)>& make);

/// Splits polygons of `surface` along a line, at all heights. New vertices are added to the surface; new edges get the side `side`.
/// In:    all polygons that share edges, in one call; `side` differs from all sides so far.
/// Error: a vertex within 1e-12 of the line, relative to its coordinates, counts as on it, so that lines through a corner leave no slivers.
[[nodiscard]] SplitResult split_by_line(geometry::Space space, PolygonMesh& surface, const std::vector<PolygonMesh::Polygon>& polygons,
                                        const geometry::Line& line, int side);
/// The same along the height z; left is above.
[[nodiscard]] SplitResult split_at_height(geometry::Space space, PolygonMesh& surface, const std::vector<PolygonMesh::Polygon>& polygons,
                                          double z, int side);

/// Triangulates a polygon with the orientation of its loop. No triangle is degenerate, and all vertices of the loop are used. When no fan
/// from a vertex of the loop does that, a vertex in the middle is added to the surface.
/// In: at least three different sides, and no two antipodal vertices.
[[nodiscard]] std::vector<mesh::Triangle> triangulate(geometry::Space space, PolygonMesh& surface, const PolygonMesh::Polygon& polygon);
/// The fan of triangles from the vertex `hub`, which lies inside the polygon or on its loop.
[[nodiscard]] std::vector<mesh::Triangle> fan(const PolygonMesh::Polygon& polygon, std::uint32_t hub);

}  // namespace orbc::place
