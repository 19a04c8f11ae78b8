#pragma once
#include <string>

#include "exporters/svg/write_svg.h"

namespace orbc::svg {

inline constexpr double kHyperboloidHeight = 0.98;  ///< of the page, divided by its width

/// Draws the hyperbolic plane as the upper sheet w² − x² − y² = 1 above its Poincaré disk: the paper's figure of the model. The rays are
/// parallel and come from the side and a little from above.
/// In:      a tiling of H²; `options.geodesics`, `colors`, `lines`, `line_color`, `labels`.
/// Makes:   the tiling on the sheet as far as the distance 1.6 from the room's centre, and on the whole disk in the plane w = 0. Of each
///          geodesic the part on the sheet, its image in the disk, and the rays from the vertex (−1, 0, 0) of the lower sheet that carry
///          its two points from the one to the other. The same bytes for the same input.
/// Formula: the ray from (−1, 0, 0) through (w, x, y) meets the plane w = 0 in (x, y)/(1 + w), the Poincaré disk.
[[nodiscard]] std::string draw_hyperboloid(const driver::Tiling& tiling, double width, const SvgOptions& options);

}  // namespace orbc::svg
