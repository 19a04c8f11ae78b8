#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "compiler/bend/copy_map.h"
#include "compiler/bend/screen_metric.h"
#include "compiler/geometry/circle.h"

namespace orbc::bend {

/// A part of the room, prepared for bending many times: each edge once, and bounds of its size. Uv are kept apart, because copies may
/// differ in them.
struct EdgeMesh {
  const place::PlacedMesh* mesh = nullptr;
  PointColumns points;                                       ///< the vertices of `mesh`
  std::vector<std::array<std::uint32_t, 2>> edges;           ///< from the smaller to the larger vertex
  std::vector<std::array<std::uint32_t, 3>> triangle_edges;  ///< edge k of a triangle joins its corners k and k + 1
  geometry::Circle circle;                                   ///< on the floor, around all vertices
  double low = 0, high = 0;                                  ///< range of heights
  double max_length = 0, max_rise = 0;                       ///< of an edge: its length on the floor, and the difference of heights
  /// How far colours may shift within the surface, in units of the tolerance. 0: colours are constant in every triangle and shift nowhere.
  double color_tolerance = 0;
};

/// In: `mesh` must outlive the result.
[[nodiscard]] EdgeMesh edge_mesh(geometry::Space space, const place::PlacedMesh& mesh, double color_tolerance);

/// An upper bound of the error, in tolerances, of drawing the part without splitting: from distances alone, without looking at any edge.
/// kUnbounded where none is known.
/// Formula: with an acceleration of at most K, a chord of length ℓ is off by at most Kℓ²/8, and a triangle by Kℓ²/6. The height is affine
///          in b, not in the arc length s: they differ by ½(tanκ(ℓu/2)/tanκ(ℓ/2) − u) with u = s/ℓ, at most ℓ²/50 for ℓ ≤ 1. In the disk
///          chart |C''| ≤ 1.5|z|(1 + κ|z|²).
[[nodiscard]] double error_bound(const CopyMap& map, const ScreenMetric& metric, const EdgeMesh& part);

}  // namespace orbc::bend
