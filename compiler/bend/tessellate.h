#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "compiler/bend/edge_mesh.h"

namespace orbc::bend {

/// A vertex that splitting has added. `v` = Σ bᵢXᵢ is not scaled back to the surface, so that v, z and uv are affine in b (design §2).
struct NewVertex {
  geometry::Ambient v;  ///< room coordinates
  double z = 0;
  std::array<double, 2> uv{};
  geometry::Vector3 image;
  bool on_circle = false;  ///< S²: it lies on an axis at which the map is torn, and `image` is one of the axis' many images
};

/// A part after splitting. Vertices 0 … n − 1 are those of the part, n … are `vertices`.
struct Tessellation {
  std::vector<NewVertex> vertices;
  std::vector<mesh::Triangle> triangles;
  std::vector<bool> decisions;  ///< whether an edge or a triangle is split, in the order in which they are judged
  double max_error = 0;         ///< largest error in the picture, in tolerances
  bool too_many = false;        ///< stopped because there are too many triangles
};

/// Splits a part until every chord and every triangle is within the tolerance. Each edge is judged from its two ends alone, in an order
/// that does not depend on the triangle: so neighbours agree, and there are no cracks and no T-junctions. On S² a triangle around an axis
/// at which the map is torn becomes a ring that ends on the circle that is the image of the axis.
/// In:     uv parallel to the part's vertices.
/// Makes:  nothing useful when more than `max_triangles` would be needed (too_many).
/// Not promised: a minimal triangle count.
[[nodiscard]] Tessellation tessellate(const CopyMap& map, const ScreenMetric& metric, const EdgeMesh& part, const Uv& uv,
                                      std::uint64_t max_triangles);

/// The same vertices and triangles from the decisions of an earlier tessellation, without judging anything.
/// Makes: images of vertices `on_circle` only; no decisions and no max_error.
[[nodiscard]] Tessellation replay_tessellation(const CopyMap& map, const ScreenMetric& metric, const EdgeMesh& part, const Uv& uv,
                                               const std::vector<bool>& decisions);

}  // namespace orbc::bend
