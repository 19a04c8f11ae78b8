#pragma once
#include <complex>
#include <string_view>
#include <vector>

#include "compiler/base/result.h"

namespace orbc::svg {

/// A closed outline, or an open line of strokes: points of the plane, y up.
using Polyline = std::vector<std::complex<double>>;

/// Reads SVG path data (M L H V C S Q T A Z, absolute and relative) as polylines, one for each subpath.
/// In:          `fineness` segments for every quarter turn of an arc and for every Bézier curve.
/// Makes:       y turned up: SVG counts it downwards.
/// Diagnostics: svg.bad-path (a wrong character, a number that is missing, too many points, nothing to draw).
/// Source:      SVG 1.1, ch. 8.3 and appendix F.6.
[[nodiscard]] Result<std::vector<Polyline>> read_path_data(std::string_view data, int fineness = 12);

}  // namespace orbc::svg
