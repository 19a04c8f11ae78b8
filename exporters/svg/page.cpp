#include "exporters/svg/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "compiler/base/check.h"
#include "compiler/base/elementary.h"
#include "compiler/geometry/chart.h"

namespace orbc::svg {
namespace {

using geometry::Line;
using geometry::Point;
using geometry::Space;
using Complex = std::complex<double>;

constexpr double kFlatArc = 0.02;            // page units: a flatter arc cannot be told from its chord

struct Extent {
  double low[2] = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  double high[2] = {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  void add(Complex z) {
    low[0] = std::min(low[0], z.real()), low[1] = std::min(low[1], z.imag());
    high[0] = std::max(high[0], z.real()), high[1] = std::max(high[1], z.imag());
  }
  [[nodiscard]] double size(int axis) const { return high[axis] - low[axis]; }
};

double cross(Complex a, Complex b) { return a.real() * b.imag() - a.imag() * b.real(); }

void move_to(std::string& d, char command, Complex z) { d += command + coordinate(z.real()) + ' ' + coordinate(z.imag()); }

/// From `p` over `m` to `q` on a circle of radius r (page units).
void arc_to(std::string& d, Complex p, Complex m, Complex q, double r) {
  const bool large = (std::conj(p - m) * (q - m)).real() > 0;  // the inscribed angle at m is acute on the greater arc only
  if (!large && std::norm(q - p) < 8 * r * kFlatArc) return move_to(d, 'L', q);  // an arc bulges by chord²/8r
  const bool clockwise_on_screen = cross(m - p, q - p) > 0;                       // y points down
  const std::string radius = coordinate(r);
  d += 'A' + radius + ' ' + radius + (large ? " 0 1 " : " 0 0 ") + (clockwise_on_screen ? "1 " : "0 ");
  d += coordinate(q.real()) + ' ' + coordinate(q.imag());
}

/// From the first point over the second to the third on a circle of curvature `bend`.
void draw_to(std::string& d, const std::array<Complex, 3>& points, double bend) {
  if (bend < 1e-12) move_to(d, 'L', points[2]);
  else arc_to(d, points[0], points[1], points[2], 1 / bend);
}

/// The part of the polygon on the left of the line a + b·x + c·y = 0 (Sutherland and Hodgman, 1974).
std::vector<Complex> clipped(const std::vector<Complex>& polygon, const Line& line) {
  const auto value = [&](Complex z) { return line.w + line.x * z.real() + line.y * z.imag(); };
  std::vector<Complex> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Complex p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    const double vp = value(p), vq = value(q);
    if (vp >= 0) kept.push_back(p);
    if ((vp >= 0) != (vq >= 0)) kept.push_back(p + (q - p) * (vp / (vp - vq)));
  }
  return kept;
}

TilePath polygon_path(const std::vector<Complex>& corners) {
  TilePath tile;
  if (corners.size() < 3) return tile;
  Extent box;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    box.add(corners[i]);
    move_to(tile.d, i == 0 ? 'M' : 'L', corners[i]);
  }
  tile.d += 'Z';
  tile.diameter = std::max(box.size(0), box.size(1));
  return tile;
}

/// S² in the gnomonic chart: the frame's square, cut by every wall's line. Works for lunes and the hemisphere as well.
TilePath gnomonic_sphere_path(const Page& page, const std::vector<Piece>& pieces, const geometry::Isometry& cover_from_room) {
  const double f = page.frame;
  std::vector<Complex> polygon{{-f, -f}, {f, -f}, {f, f}, {-f, f}};
  for (const Piece& piece : pieces) polygon = clipped(polygon, cover_from_room * piece.line);
  for (Complex& z : polygon) z = page.middle + page.scale * std::conj(z);
  return polygon_path(polygon);
}

bool holds_antipode(const std::vector<Piece>& pieces, const geometry::Isometry& cover_from_room) {
  const geometry::Ambient antipode{-1, 0, 0};
  return std::all_of(pieces.begin(), pieces.end(),
                     [&](const Piece& piece) { return value_at(cover_from_room * piece.line, antipode) > 0; });
}

}  // namespace

std::string coordinate(double value) {
  char text[400];
  char* end = fmt::format_to(text, "{:.3f}", value);
  while (end[-1] == '0') --end;
  if (end[-1] == '.') --end;
  const std::string result(text, end);
  return result == "-0" ? "0" : result;
}

std::vector<Piece> outline_pieces(const room::Room& room) {
  ORBC_CHECK(room.outline.size(), >=, 2u);
  ORBC_CHECK(room.outline_wall.size(), ==, room.outline.size());
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < room.outline.size(); ++i) {
    const Point &p = room.outline[i], &q = room.outline[(i + 1) % room.outline.size()];
    pieces.push_back({p, midpoint(room.space, p, q), q, room.walls[static_cast<std::size_t>(room.outline_wall[i])].line});
  }
  return pieces;
}

namespace {

/// The pieces to the left of a line (Sutherland and Hodgman, 1974), closed along it. Convex rooms: the border goes out once and comes in
/// once.
std::vector<Piece> left_of(Space space, const std::vector<Piece>& pieces, const Line& line) {
  const auto inside = [&](const Point& p) { return value_at(line, p) >= 0; };
  std::vector<Piece> kept;
  std::optional<Point> out, in;
  std::size_t gap = 0;   // where the line goes in
  for (const Piece& piece : pieces) {
    const bool from = inside(piece.from), to = inside(piece.to);
    if (!from && !to) continue;
    Piece part = piece;
    if (from != to) {
      // On the chord, and back to the surface: the geodesic between the two meets the line there.
      const double a = value_at(line, piece.from), b = value_at(line, piece.to), t = a / (a - b);
      const Point at = geometry::normalised_point(space, (1 - t) * piece.from + t * piece.to);
      (from ? part.to : part.from) = at;
      part.middle = geometry::midpoint(space, part.from, part.to);
      if (from) out = at, gap = kept.size() + 1;
      else in = at;
    }
    kept.push_back(part);
  }
  if (out && in) kept.insert(kept.begin() + static_cast<std::ptrdiff_t>(gap), {*out, geometry::midpoint(space, *out, *in), *in, line});
  return kept;
}

}  // namespace

std::vector<Piece> seen_pieces(Space space, const std::vector<Piece>& pieces, const cover::Copy& copy,
                               const geometry::Isometry& room_from_eye) {
  std::vector<Piece> seen;
  for (const Piece& p : pieces) {
    const auto& map = copy.cover_from_room;
    seen.push_back({map * p.from, map * p.middle, map * p.to, map * p.line});
  }
  if (!copy.wedge) return seen;
  // Counter-clockwise, so that the line along which it is closed runs the same way as the others.
  if (copy.cover_from_room.reversing) {
    std::reverse(seen.begin(), seen.end());
    for (Piece& p : seen) std::swap(p.from, p.to);
  }
  const cover::Bearing &from = copy.wedge->from, &to = copy.wedge->to;
  for (const Line& border : {Line{0, -from.y, from.x}, Line{0, to.y, -to.x}}) seen = left_of(space, seen, room_from_eye * border);
  return seen;
}

Complex on_page(const Page& page, const Point& p) {
  Complex z;
  if (page.half_plane) {
    const double height = 1 / (p.w - p.x);  // i(1 + z)/(1 − z) of the disk's z, without its cancellation
    z = {-p.y * height, height};
  } else if (page.straight) {
    z = geometry::gnomonic_from_point(p);
  } else if (page.space == Space::spherical) {
    z = Complex(p.x, p.y) / std::max(1 + p.w, 1e-7);
  } else {
    z = page.turn * geometry::disk_from_point(page.space, p);
  }
  return page.middle + page.scale * std::conj(z);
}

Page make_page(const driver::Tiling& tiling, const std::vector<Piece>& pieces, double width) {
  Page page;
  page.space = tiling.room.space;
  page.straight = tiling.model == driver::Tiling::Model::klein && page.space != Space::euclidean;
  page.width = page.height = width;
  page.middle = {width / 2, width / 2};
  page.unit = width / 1000;
  if (page.space != Space::euclidean) {
    page.frame = page.space == Space::hyperbolic ? 1 : page.straight ? kGnomonicFrame : kStereographicFrame;
    page.scale = (width / 2 - kMargin) / page.frame;
    return page;
  }
  Extent box;
  for (const Piece& piece : pieces) box.add({piece.from.x, piece.from.y});
  for (const cover::Copy& copy : tiling.copies)
    for (const Piece& piece : pieces) {
      const Point p = copy.cover_from_room * piece.from;
      box.add({p.x, p.y});
    }
  // A strip is long and low: the page follows it, between square and 4 : 1 or 1 : 2.
  const double aspect = std::clamp(box.size(1) / box.size(0), 0.25, 2.0);
  page.height = width * aspect;
  page.scale = std::min((width - 2 * kMargin) / box.size(0), (page.height - 2 * kMargin) / box.size(1));
  page.middle =
      Complex(width, page.height) / 2.0 - page.scale * std::conj(Complex(box.low[0] + box.high[0], box.low[1] + box.high[1]) / 2.0);
  return page;
}

std::string open_path(const Page& page, const Piece& piece) {
  const std::array<Complex, 3> points = {on_page(page, piece.from), on_page(page, piece.middle), on_page(page, piece.to)};
  std::string d;
  move_to(d, 'M', points[0]);
  draw_to(d, points, bend_of(page, piece.line));
  return d;
}

double bend_of(const Page& page, const Line& line) {
  if (page.straight || page.space == Space::euclidean) return 0;
  // Half-plane: (w + x)(X² + Y²)/2 − yX + (w − x)/2 = 0, a circle of radius 1/|w + x| about y/(w + x).
  return std::fabs(page.half_plane ? line.w + line.x : line.w) / page.scale;
}

Box box_on_page(const Page& page, const std::vector<Piece>& pieces, const geometry::Isometry& cover_from_room) {
  Extent extent;
  for (const Piece& piece : pieces) {
    extent.add(on_page(page, cover_from_room * piece.from));
    extent.add(on_page(page, cover_from_room * piece.middle));
  }
  return {extent.low[0], extent.low[1], extent.high[0], extent.high[1]};
}

bool is_outside(const Page& page, const Box& box) {
  if (!page.window) return false;
  const Box& w = *page.window;
  return box.right < w.left || box.left > w.right || box.bottom < w.top || box.top > w.bottom;
}

TilePath tile_path(const Page& page, const std::vector<Piece>& pieces, const geometry::Isometry& cover_from_room) {
  if (page.straight && page.space == Space::spherical) return gnomonic_sphere_path(page, pieces, cover_from_room);
  TilePath tile;
  Extent box;
  double nearest = std::numeric_limits<double>::infinity();  // of the outline to the middle of the page
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Complex p = on_page(page, cover_from_room * pieces[i].from), q = on_page(page, cover_from_room * pieces[i].to);
    const Complex m = on_page(page, cover_from_room * pieces[i].middle);
    box.add(p);
    box.add(m);
    nearest = std::min({nearest, math::abs(p - page.middle), math::abs(m - page.middle)});
    if (i == 0) move_to(tile.d, 'M', p);
    draw_to(tile.d, {p, m, q}, bend_of(page, cover_from_room * pieces[i].line));
  }
  if (is_outside(page, {box.low[0], box.low[1], box.high[0], box.high[1]})) return {};
  tile.d += 'Z';
  tile.diameter = std::max(box.size(0), box.size(1));
  if (page.space == Space::spherical) {
    const double rim = page.scale * page.frame;
    if (holds_antipode(pieces, cover_from_room)) {
      const std::string r = coordinate(1.01 * rim), left = coordinate(page.middle.real() - 1.01 * rim),
                        right = coordinate(page.middle.real() + 1.01 * rim);
      const std::string y = coordinate(page.middle.imag());
      tile.d +=
          'M' + left + ' ' + y + 'A' + r + ' ' + r + " 0 0 1 " + right + ' ' + y + 'A' + r + ' ' + r + " 0 0 1 " + left + ' ' + y + 'Z';
      tile.diameter = 2 * rim;
    } else if (nearest > 3 * rim) {
      return {};
    }
  }
  return tile;
}

}  // namespace orbc::svg
