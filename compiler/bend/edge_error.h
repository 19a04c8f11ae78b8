#pragma once
#include "compiler/bend/torn_map.h"

namespace orbc::bend {

/// Whether an edge must be split, and how far its chord is from the true curve.
struct EdgeVerdict {
  bool split = false;
  bool at_bisector = false;           ///< the error is largest at TornMap::bisection: split the edge there, not at its middle
  bool far_within_tolerance = false;  ///< by distances alone; a triangle with three such edges is within the tolerance, too
  double error = 0;                   ///< of an edge that is not split, in tolerances; 0 when it cannot be in the picture
};

/// Judges an edge from its two ends.
/// In: colour tolerance as in EdgeMesh. The order of the ends must not depend on the triangle, so that neighbours agree bit by bit.
[[nodiscard]] EdgeVerdict judge_edge(const TornMap& map, const ScreenMetric& metric, double color_tolerance, const Corner& a,
                                     const Corner& b);

/// The error of a flat triangle whose edges are within the tolerance, at its centroid.
/// In: its corners, none of them on an axis.
[[nodiscard]] ChordError triangle_error(const TornMap& map, const ScreenMetric& metric, double color_tolerance,
                                        const std::array<const Corner*, 3>& corners);

}  // namespace orbc::bend
