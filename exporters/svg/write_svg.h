#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "compiler/driver/product.h"
#include "exporters/svg/geodesic.h"
#include "exporters/svg/motif.h"
#include "exporters/svg/page.h"

namespace orbc::svg {

struct SvgOptions {
  double width = 1000;    ///< of the picture, in user units (pixels at scale 1)
  double smallest = 0.3;  ///< copies narrower than this many units are left out
  bool labels = true;     ///< orders of the corners, numbers of the walls, caption
  bool tooltips = true;   ///< the word of a copy appears under the mouse
  /// "#rrggbb" of the room and its even images, and of mirror images (parity), or of both ends of the ramp (length); none: the palette's
  std::optional<std::array<std::string, 2>> colors = {};
  double lines = 1.2;      ///< width of the lines between large copies, in page units (Page::unit); smaller copies have thinner ones
  std::string line_color;  ///< "#rrggbb"; "" = paper
  Motif motif;             ///< stands in every copy; placed in the room (motif.h)
  bool cuts = false;       ///< the cuts of the paper's decomposition
  std::vector<Geodesic> geodesics;
  std::string unit;        ///< of the picture's width and height, "mm"; "" = user units
  double per_unit = 1;     ///< user units in a `unit`
};

/// Draws the tiling of the floor: the paper's Figures 5 and 11.
/// In:     a room whose outline has at least two points; copies of it (further sheets of S² and storeys are skipped, they lie on the
///         first); copies with a wedge are cut to it.
/// Makes:  one SVG file. disk: the conformal chart, walls are true circular arcs (H²: the whole Poincaré disk; S²: stereographic, as far as
///         1.8 equator radii; E²: everything). klein: the gnomonic chart, walls are straight (S²: the near hemisphere as far as 2 radii).
///         plane: the same as disk; E² has no other. The same bytes for the same tiling.
[[nodiscard]] std::vector<driver::File> write_svg(const driver::Tiling& tiling, const SvgOptions& options = {});

/// The same on a page of one's own, for instance of make_room_page; the caption has `caption` units at its foot (labels only).
[[nodiscard]] std::string draw_tiling(const driver::Tiling& tiling, const Page& page, double caption, const SvgOptions& options);

/// The caption at the foot of a page: the title, and what chart it is.
[[nodiscard]] std::string caption_line(const std::string& title, const Page& page, geometry::Space space);

/// Height of a caption on a page so wide.
[[nodiscard]] double caption_height(double width);

}  // namespace orbc::svg
