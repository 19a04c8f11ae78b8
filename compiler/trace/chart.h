#pragma once
#include <vector>

#include "compiler/geometry/isometry.h"
#include "compiler/trace/pack.h"
#include "compiler/trace/soup.h"

namespace orbc::trace {

/// A gnomonic chart around its own centre, and the tree of the triangles that belong to it.
struct Chart {
  geometry::Matrix3 chart_from_room{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  bool moved = false;               ///< the map is not the identity
  double radius = 0;                ///< largest arc from the centre to a corner of a triangle
  double tangent = 0;               ///< tanκ(radius)
  double nearest_foot2 = 0;         ///< cosκ²(radius): geodesics whose foot lies farther out miss the chart
  float extent = 0;                 ///< largest |(x, y)/w| of a corner
  float largest_w = 1;              ///< of a corner: 1 on S², cosh(radius) on H²
  float ratio = 1;                  ///< bound of the ratio of two corners' w
  int terms = 1;                    ///< of the odd polynomial
  float poly[7] = {1, 0, 0, 0, 0, 0, 0};  ///< tanκ(a) ≈ Σ poly[k]·a^(2k+1), increasing on all of ℝ
  float poly_error = 0;             ///< its largest error for |a| ≤ radius, in the float evaluation
  int arc_terms = 0;                ///< of the leaf test's odd polynomial; 0: the chart is too wide for one
  float arc_poly[7] = {1, 0, 0, 0, 0, 0, 0};  ///< arc of tanκ: atanκ(t) ≈ Σ arc_poly[k]·t^(2k+1) for |t| ≤ tangent
  float arc_error = 0;              ///< bound of its error (or of the general function's), in the float evaluation
  float last_slope = 1, sharpest_arc = 0;  ///< atanκ′(tangent) and max|atanκ″| up to there
  float bend_of_height = 0;         ///< bound of a height's bend between two crossings, per change of the height and of 1/w (leaf test)
  std::vector<Node8> nodes;         ///< nodes[0] is the root
  std::vector<Block8> blocks;
};

/// Triangles that share a chart.
struct ChartPlan {
  geometry::Point centre;
  double radius = 0;
  std::vector<std::uint32_t> triangles;
};

struct ChartPlans {
  std::vector<ChartPlan> charts;
  std::vector<std::uint32_t> large; ///< triangles too large for any chart (S²: corners > 80° from its centre; H²: > 3): tried one by one
};

/// Divides the triangles among as few charts as the spaces allow: each chart's corners lie within 1.15 of its centre on S² (a room with
/// three or more corners then has one chart, lunes two, the hemisphere a few) and within 1.8 on H²; E² has one.
[[nodiscard]] ChartPlans plan_charts(geometry::Space space, const Soup& soup);

/// Makes the chart's map and polynomials (no tree yet).
/// Exact: `poly` is checked to be increasing and its error measured; both enter the padding of the node test.
[[nodiscard]] Chart make_chart(geometry::Space space, const ChartPlan& plan, const Soup& soup);

}  // namespace orbc::trace
