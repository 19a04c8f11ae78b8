#pragma once
#include <vector>

#include "compiler/geometry/isometry.h"
#include "compiler/trace/bvh/node.h"
#include "compiler/trace/bvh/scene_triangles.h"

namespace orbc::trace {

/// A gnomonic chart around its own centre, and the BVH of the triangles that belong to it.
struct ChartTree {
  geometry::Matrix3 chart_from_room{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  bool moved = false;       ///< whether chart_from_room is not the identity
  double radius = 0;        ///< largest arc from the centre to a corner of a triangle
  double tan_radius = 0;    ///< tanκ(radius)
  double foot_bound2 = 0;   ///< cosκ²(radius): a geodesic whose foot of the perpendicular lies farther out misses the chart
  float extent = 0;         ///< largest |(x, y)/w| of a corner
  float max_w = 1;          ///< largest w of a corner: 1 on S², cosh(radius) on H²
  float w_ratio_bound = 1;  ///< of two corners' w
  int tan_terms = 1;        ///< number of terms of tan_poly
  float tan_poly[7] = {1, 0, 0, 0, 0, 0, 0};          ///< tanκ(a) ≈ Σ tan_poly[k]·a^(2k+1), increasing on all of ℝ
  float tan_error = 0;                                ///< largest error of tan_poly for |a| ≤ radius, evaluated in float
  int arc_terms = 0;                                  ///< number of terms of arc_poly; 0: the chart is too wide for a polynomial
  float arc_poly[7] = {1, 0, 0, 0, 0, 0, 0};          ///< atanκ(t) ≈ Σ arc_poly[k]·t^(2k+1) for |t| ≤ tan_radius
  float arc_error = 0;                                ///< bound of the error of arc_poly, or of general_arc, evaluated in float
  float arc_slope_at_end = 1, max_arc_curvature = 0;  ///< atanκ′(tan_radius) and max|atanκ″| up to there
  float height_bend_bound = 0;  ///< leaf test: bound of a height's deviation from its chord, per change of the height and of 1/w
  std::vector<Node8> nodes;     ///< nodes[0] is the root
  std::vector<Block8> blocks;
};

/// Triangles that share a chart, and the smallest known disk around their corners.
struct ChartCluster {
  geometry::Point centre;
  double radius = 0;  ///< largest distance of a corner from the centre
  std::vector<std::uint32_t> triangles;
};

struct ChartClusters {
  std::vector<ChartCluster> charts;
  std::vector<std::uint32_t>
      uncharted;  ///< triangles too large for a chart (S²: corners > 80° from the centre; H²: > 3), which are tested one by one
};

/// Divides the triangles among few charts. Each chart's corners lie within 1.15 of its centre on S² (a room with three or more corners then
/// has one chart, a lune two, the hemisphere a few) and within 1.8 on H². E² has one chart.
[[nodiscard]] ChartClusters cluster_into_charts(geometry::Space space, const SceneTriangles& scene);

/// Makes the map and the polynomials of a cluster's chart, without its tree.
/// Exact: `tan_poly` is checked to be increasing and its error is measured; the error enters the padding of the node test.
[[nodiscard]] ChartTree make_chart(geometry::Space space, const ChartCluster& cluster, const SceneTriangles& scene);

}  // namespace orbc::trace
