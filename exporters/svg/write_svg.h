#pragma once
#include <vector>

#include "compiler/driver/product.h"

namespace orbc::svg {

struct SvgOptions {
  double width = 1000;        ///< of the picture, in user units (pixels at scale 1)
  double smallest = 0.3;      ///< copies narrower than this many units are left out
  bool labels = true;         ///< orders of the corners, numbers of the walls, caption
  bool tooltips = true;       ///< the word of a copy appears under the mouse
};

/// Draws the tiling of the floor: the paper's Figures 5 and 11.
/// In:     a room whose outline has at least two points; copies of it (further sheets of S² and storeys are skipped, they lie on the
///         first); copies with a wedge are cut to it.
/// Makes:  one SVG file. disk: the conformal chart, walls are true circular arcs (H²: the whole Poincaré disk; S²: stereographic, as far as
///         1.8 equator radii; E²: everything). klein: the gnomonic chart, walls are straight (S²: the near hemisphere as far as 2 radii).
///         plane: the same as disk; E² has no other. The same bytes for the same tiling.
[[nodiscard]] std::vector<driver::File> write_svg(const driver::Tiling& tiling, const SvgOptions& options = {});

}  // namespace orbc::svg
