#include "exporters/svg/hyperboloid.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "compiler/base/elementary.h"
#include "exporters/svg/labels.h"
#include "exporters/svg/palette.h"

namespace orbc::svg {
namespace {

using Complex = std::complex<double>;
using geometry::Ambient;
using geometry::Point;
using geometry::Space;

constexpr double kRim = 1.6;  // distance from the centre where the sheet is cut off

constexpr double kElevation = 17 * std::numbers::pi / 180;  // of the parallel rays above the horizon
constexpr double kFoot = 62;                                // page units below the vertex of the lower sheet
constexpr double kSmallestInDisk = 1.5;                     // page units: smaller copies in the disk are left to its background
constexpr double kStep = 0.12;                              // length of the pieces of walls on the sheet

/// Parallel projection of the ambient space: w is up, y away from the viewer.
struct View {
  double width = 1000, scale = 1;
  double sin = math::sin(kElevation), cos = math::cos(kElevation);

  [[nodiscard]] double unit() const { return width / 1000; }
  [[nodiscard]] double height() const { return kHyperboloidHeight * width; }
  [[nodiscard]] Complex at(const Ambient& p) const {
    return {width / 2 + scale * p.x, height() - kFoot * unit() - scale * ((p.w + 1) * cos + p.y * sin)};
  }
  /// Whether the viewer sees the outside of the sheet there: the outer normal (x, y, −w) points against the rays.
  [[nodiscard]] bool sees_outside(const Ambient& p) const { return -p.y * cos - p.w * sin > 0; }
};

View view_of(double width) {
  View view{width};
  const double rim = math::sinh(kRim), top = (math::cosh(kRim) + 1) * view.cos + rim * view.sin;
  view.scale = std::min((width - 40 * view.unit()) / (2 * rim), (view.height() - (kFoot + 20) * view.unit()) / top);
  return view;
}

std::string path_of(const View& view, const std::vector<Ambient>& points, bool is_closed) {
  std::string d;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Complex z = view.at(points[i]);
    d += i == 0 ? 'M' : 'L';
    d += coordinate(z.real()) + ' ' + coordinate(z.imag());
  }
  if (!d.empty() && is_closed) d += 'Z';
  return d;
}

/// The border of a copy on the sheet, in pieces of at most kStep.
std::vector<Ambient> border_of(const std::vector<Piece>& pieces, const geometry::Isometry& map) {
  std::vector<Ambient> border;
  for (const Piece& piece : pieces) {
    const Point from = map * piece.from, to = map * piece.to;
    const double length = geometry::distance(Space::hyperbolic, from, to);
    if (length == 0) continue;
    const geometry::Tangent along = geometry::direction_to(Space::hyperbolic, from, to);
    const int count = static_cast<int>(std::ceil(length / kStep));
    for (int i = 0; i < count; ++i) border.push_back(geometry::point_along(Space::hyperbolic, from, along, length * i / count));
  }
  return border;
}

/// The part of a polygon below the rim (Sutherland and Hodgman, 1974). New points lie on the chord of two near ones, moved to the sheet.
std::vector<Ambient> below_rim(const std::vector<Ambient>& polygon) {
  const double rim = math::cosh(kRim);
  std::vector<Ambient> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Ambient &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    if (p.w <= rim) kept.push_back(p);
    if ((p.w <= rim) != (q.w <= rim)) {
      const double t = (rim - p.w) / (q.w - p.w);
      kept.push_back(geometry::normalised_point(Space::hyperbolic, (1 - t) * p + t * q));
    }
  }
  return kept;
}

Ambient in_disk(const Ambient& p) { return {0, p.x / (1 + p.w), p.y / (1 + p.w)}; }

/// A tile of the sheet, with what decides when it is painted.
struct SheetTile {
  std::string d, fill;
  bool outside = false;  ///< the viewer sees its outside
  double depth = 0;      ///< greater: farther away
};

std::vector<SheetTile> sheet_tiles(const driver::Tiling& tiling, const View& view, const SvgOptions& options) {
  const std::vector<Piece> pieces = outline_pieces(tiling.room);
  std::vector<SheetTile> tiles;
  for (const cover::Copy& copy : tiling.copies) {
    const std::vector<Ambient> border = below_rim(border_of(pieces, copy.cover_from_room));
    if (border.size() < 3) continue;
    Ambient middle{0, 0, 0};
    for (const Ambient& p : border) middle = middle + (1.0 / static_cast<double>(border.size())) * p;
    tiles.push_back({path_of(view, border, true), fill_of(copy, 6, tiling.coloring, options.colors), view.sees_outside(middle),
                     middle.y * view.cos - middle.w * view.sin});
  }
  // The far side is seen from inside and lies behind the near side.
  std::stable_sort(tiles.begin(), tiles.end(),
                   [](const SheetTile& a, const SheetTile& b) { return a.outside != b.outside ? b.outside : a.depth > b.depth; });
  return tiles;
}

std::string disk_tiles(const driver::Tiling& tiling, const View& view, const SvgOptions& options) {
  const std::vector<Piece> pieces = outline_pieces(tiling.room);
  std::string out;
  for (const cover::Copy& copy : tiling.copies) {
    // The chart shrinks lengths at a point by 1 + w.
    const Point middle = copy.cover_from_room * Point();
    if (view.scale * 2 * tiling.room.circumradius / (1 + middle.w) < kSmallestInDisk * view.unit()) continue;
    std::vector<Ambient> border = border_of(pieces, copy.cover_from_room);
    for (Ambient& p : border) p = in_disk(p);
    out += "<path fill=\"" + fill_of(copy, 6, tiling.coloring, options.colors) + "\" d=\"" + path_of(view, border, true) + "\"/>\n";
  }
  return out;
}

std::vector<Ambient> circle_at(double w, double radius) {
  std::vector<Ambient> points;
  for (int i = 0; i < 96; ++i) {
    const double angle = 2 * std::numbers::pi * i / 96;
    points.push_back({w, radius * math::cos(angle), radius * math::sin(angle)});
  }
  return points;
}

std::string stroked(const std::string& d, const char* color, double width, const std::string& more = "") {
  return d.empty() ? ""
                   : "<path fill=\"none\" stroke=\"" + std::string(color) + "\"" + attribute("stroke-width", width) + more + " d=\"" + d +
                         "\"/>\n";
}

std::string dot(const View& view, const Ambient& p) {
  const Complex z = view.at(p);
  return "<circle fill=\"" + std::string(kPaper) + "\" stroke=\"" + kInk + "\"" + attribute("stroke-width", 2.2 * view.unit()) +
         attribute("cx", z.real()) + attribute("cy", z.imag()) + attribute("r", 6 * view.unit()) + "/>\n";
}

/// A geodesic on the sheet and in the disk, and the rays between the two.
std::string geodesic_figure(const View& view, const Geodesic& geodesic) {
  std::vector<Ambient> on_sheet, on_disk;
  const double rim = math::cosh(kRim);
  for (const Point& p : points_on(Space::hyperbolic, geodesic, 8, 0.05)) {
    if (p.w <= rim) on_sheet.push_back(p);
    on_disk.push_back(in_disk(p));
  }
  const double u = view.unit();
  std::string out = stroked(path_of(view, on_disk, false), kPaper, 6 * u) + stroked(path_of(view, on_disk, false), kInk, 3 * u) +
                    stroked(path_of(view, on_sheet, false), kPaper, 6 * u) + stroked(path_of(view, on_sheet, false), kInk, 3 * u);
  const std::string dashes = " stroke-dasharray=\"" + coordinate(7 * u) + " " + coordinate(5 * u) + "\"";
  for (const Point& p : {geodesic.from, geodesic.to}) {
    out += stroked(path_of(view, {{-1, 0, 0}, p}, false), kInk, 1.6 * u, dashes);
    out += dot(view, in_disk(p)) + (p.w <= rim ? dot(view, p) : "");
  }
  return out + dot(view, {-1, 0, 0});
}

std::string begin_of(const View& view, const driver::Tiling& tiling, const SvgOptions& options) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
         coordinate(view.width / options.per_unit) + options.unit + "\" height=\"" + coordinate(view.height() / options.per_unit) +
         options.unit + "\" viewBox=\"0 0 " + coordinate(view.width) + " " + coordinate(view.height()) + "\" role=\"img\">\n<title>" +
         escaped(tiling.title) + "</title>\n<desc>The mirror room " + escaped(tiling.title) +
         " and its copies on the upper sheet of a hyperboloid, and below it in the Poincaré disk.</desc>\n" +
         "<rect width=\"100%\" height=\"100%\" fill=\"" + kPaper + "\"/>\n";
}

}  // namespace

std::string draw_hyperboloid(const driver::Tiling& tiling, double width, const SvgOptions& options) {
  const View view = view_of(width);
  const double u = view.unit();
  const std::string line_color = options.line_color.empty() ? kPaper : options.line_color;
  const std::string seam = " stroke=\"" + line_color + "\" stroke-linejoin=\"round\"" + attribute("stroke-width", options.lines * u);
  std::string out = begin_of(view, tiling, options);
  const std::string disk = path_of(view, circle_at(0, 1), true);
  out += "<path fill=\"" + haze(tiling.coloring, options.colors) + "\" d=\"" + disk + "\"/>\n";
  const std::string thin = " stroke=\"" + line_color + "\"" + attribute("stroke-width", 0.25 * options.lines * u);
  out += "<g" + thin + ">\n" + disk_tiles(tiling, view, options) + "</g>\n" + stroked(disk, kInk, 1.6 * u);
  const std::vector<SheetTile> tiles = sheet_tiles(tiling, view, options);
  const auto first_outside = std::find_if(tiles.begin(), tiles.end(), [](const SheetTile& tile) { return tile.outside; });
  const std::string rim = path_of(view, circle_at(math::cosh(kRim), math::sinh(kRim)), true);
  out += "<g" + seam + ">\n";
  for (auto tile = tiles.begin(); tile != first_outside; ++tile) out += "<path fill=\"" + tile->fill + "\" d=\"" + tile->d + "\"/>\n";
  // What is nearer lets the inside be seen through it.
  out += "</g>\n" + stroked(rim, kInk, 1.6 * u) + "<g fill-opacity=\"0.72\"" + seam + ">\n";
  for (auto tile = first_outside; tile != tiles.end(); ++tile) out += "<path fill=\"" + tile->fill + "\" d=\"" + tile->d + "\"/>\n";
  out += "</g>\n";
  for (const Geodesic& geodesic : options.geodesics) out += geodesic_figure(view, geodesic);
  if (options.labels)
    out += "<text text-anchor=\"middle\" font-family=\"Georgia, 'Times New Roman', serif\" fill=\"" + std::string(kInk) + "\"" +
           attribute("x", width / 2) + attribute("y", view.height() - 12 * u) + attribute("font-size", 19 * u) +
           "><tspan font-weight=\"bold\">" + escaped(tiling.title) + "</tspan><tspan" + attribute("dx", 8 * u) +
           " fill-opacity=\"0.7\">— hyperbolic plane, hyperboloid above its Poincaré disk</tspan></text>\n";
  return out + "</svg>\n";
}

}  // namespace orbc::svg
