#pragma once
#include <array>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "compiler/driver/product.h"

namespace orbc::svg {

inline constexpr double kMargin = 16;                ///< on a page 1000 wide
inline constexpr double kStereographicFrame = 1.8;   ///< chart radius; the equator's is 1: all but 58° around the antipode
inline constexpr double kGnomonicFrame = 2;          ///< 63° around the centre

/// A rectangle of the page.
struct Box {
  double left = 0, top = 0, right = 0, bottom = 0;
};

/// How chart coordinates lie on the page: x to the right, y down, `scale` units per chart length.
struct Page {
  geometry::Space space = geometry::Space::euclidean;
  bool straight = false;              ///< gnomonic chart instead of the conformal one
  double width = 0, height = 0;
  std::complex<double> middle;        ///< page position of the chart's origin
  double scale = 1;
  double frame = 0;                   ///< chart radius of the round frame; 0 = no frame
  bool half_plane = false;            ///< H² as the upper half-plane, the origin of the disk at i; `middle` is the 0 of its border
  std::complex<double> turn = 1;      ///< E²: the chart is turned by this before it lies on the page
  double unit = 1;                    ///< what lines, letters and margins are measured in: 1 on a page 1000 wide
  std::optional<Box> window;          ///< nothing is drawn outside; none: no limit but the round frame
};

/// One piece of a wall between neighbouring points of the room's outline; shorter than π on S².
struct Piece {
  geometry::Point from, middle, to;
  geometry::Line line;                ///< the wall, inside to the left
};

[[nodiscard]] std::vector<Piece> outline_pieces(const room::Room& room);

/// The pieces of a copy, in the cover, cut to its wedge: what an eye at `room_from_eye` sees of it there. Nothing when that is nothing.
/// In: the pieces of the room; a copy of sheet 0.
[[nodiscard]] std::vector<Piece> seen_pieces(geometry::Space space, const std::vector<Piece>& pieces, const cover::Copy& copy,
                                             const geometry::Isometry& room_from_eye);

/// Fits the tiling on a page `width` wide. `pieces` are those of its room.
[[nodiscard]] Page make_page(const driver::Tiling& tiling, const std::vector<Piece>& pieces, double width);

/// What a page for a whole tiling is to be.
struct PageSize {
  double width = 1000;
  double height = 0;                  ///< 0: what suits the room
  double caption = 0;                 ///< height that is kept free below the picture
  bool full_bleed = false;            ///< flat tilings reach the edge of the page
};
enum class Chart { disk, klein, half_plane, hyperboloid };

/// A page that shows the tiling by a room as far as it goes: S² and H² round, E² a window of some rooms across, strips as bands.
/// Walls of rectangles and strips run along the edges of the page. half_plane: H² only. hyperboloid: the page of the disk.
[[nodiscard]] Page make_room_page(const room::Room& room, Chart chart, const PageSize& size);

/// Where a line has its circle on the page: 1/radius in page units; 0 = a straight line.
[[nodiscard]] double bend_of(const Page& page, const geometry::Line& line);

/// The box of the ends and middles of pieces on the page.
[[nodiscard]] Box box_on_page(const Page& page, const std::vector<Piece>& pieces, const geometry::Isometry& cover_from_room);
[[nodiscard]] bool is_outside(const Page& page, const Box& box);

/// In H² the chart's rim is never reached, on S² points near the antipode of the origin stay finite.
[[nodiscard]] std::complex<double> on_page(const Page& page, const geometry::Point& p);

/// A copy as an SVG path, closed.
struct TilePath {
  std::string d;                      ///< "" when nothing of it is on the page
  double diameter = 0;                ///< of its box on the page
};

/// In:      the pieces of the room and where the copy lies.
/// Formula: in the conformal chart the line (w, l) is the circle about l/(κw) with radius 1/|w|.
/// Makes:   arcs (`A`) where they bulge by more than 1/50 unit, else straight lines. The copy of S² that holds the antipode of the origin
///          becomes the frame minus its outline (fill rule evenodd).
[[nodiscard]] TilePath tile_path(const Page& page, const std::vector<Piece>& pieces, const geometry::Isometry& cover_from_room);

/// One piece alone, not closed.
[[nodiscard]] std::string open_path(const Page& page, const Piece& piece);

/// A page coordinate: three digits after the point, no trailing zeros.
[[nodiscard]] std::string coordinate(double value);

}  // namespace orbc::svg
