#include "exporters/svg/draw_glued.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/geometry/chart.h"
#include "exporters/svg/labels.h"
#include "exporters/svg/palette.h"

namespace orbc::svg {
namespace {

using Complex = std::complex<double>;
using geometry::Isometry;
using geometry::Point;

/// The polygon as a room, whose walls are its sides.
room::Room room_of(const room::GluedPolygon& polygon) {
  const geometry::Space space = polygon.space;
  room::Room room;
  room.space = space;
  room.inradius = polygon.inradius;
  for (std::size_t i = 0; i < polygon.sides.size(); ++i) {
    const Point from = geometry::point_from_disk(space, polygon.corners[i]);
    const Point touch = geometry::rotation(space, polygon.touch_angles[i]) * geometry::point_from_log(space, {polygon.inradius, 0});
    // The side of a flat corner touches the circle in its end; the sides of a digon are so long that they need a point between.
    const bool is_digon = polygon.sides.size() == 2;
    const Point to = is_digon ? touch : geometry::point_from_disk(space, polygon.corners[(i + 1) % polygon.corners.size()]);
    room.walls.push_back({geometry::line_through(space, from, to), from, geometry::direction_to(space, from, to), polygon.sides[i].length});
    room.corners.push_back({from, 2 * std::numbers::pi / polygon.corner_fraction[i]});
    room.outline.push_back(from);
    room.outline_wall.push_back(static_cast<int>(i));
    if (is_digon) {
      room.outline.push_back(touch);
      room.outline_wall.push_back(static_cast<int>(i));
    }
    room.circumradius = std::max(room.circumradius, geometry::distance(space, Point(), from));
  }
  return room;
}

/// Where copies have their centres; no two of them are nearer than twice the inradius.
class Centres {
 public:
  explicit Centres(double inradius) : cell_(inradius) {}
  /// True if no copy has its centre there yet.
  bool insert(const Point& p) {
    const auto x = static_cast<long long>(std::floor(p.x / cell_)), y = static_cast<long long>(std::floor(p.y / cell_));
    for (long long i = x - 1; i <= x + 1; ++i)
      for (long long j = y - 1; j <= y + 1; ++j)
        if (const auto found = known_.find({i, j}); found != known_.end())
          for (const Point& q : found->second)
            if (std::fabs(p.x - q.x) + std::fabs(p.y - q.y) + std::fabs(p.w - q.w) < cell_ / 2) return false;
    known_[{x, y}].push_back(p);
    return true;
  }

 private:
  double cell_;
  std::map<std::array<long long, 2>, std::vector<Point>> known_;
};

/// The sphere is turned by less than a pixel, so that no side runs exactly through the point that the chart sends to infinity.
Isometry page_from_room(geometry::Space space) {
  constexpr double kTurn = 1e-3;
  return space == geometry::Space::spherical ? geometry::translation_by(space, kTurn, 0.61 * kTurn) : geometry::identity(space);
}

/// The copies that are large enough to be seen, ring by ring. A copy that is too small has only smaller ones behind it, or seen ones that
/// are reached otherwise.
std::vector<cover::Copy> copies_on(const Page& page, const room::Room& room, const std::vector<Isometry>& crossings,
                                   const FillOptions& options) {
  const std::vector<Piece> pieces = outline_pieces(room);
  std::vector<cover::Copy> copies(1);
  copies[0].cover_from_room = page_from_room(room.space);
  Centres centres(room.inradius);
  (void)centres.insert(copies[0].cover_from_room * Point());
  for (std::size_t next = 0; next < copies.size() && copies.size() < options.max_copies; ++next) {
    for (std::size_t side = 0; side < crossings.size(); ++side) {
      cover::Copy copy;
      copy.cover_from_room = geometry::renormalised(copies[next].cover_from_room * crossings[side]);
      if (!centres.insert(copy.cover_from_room * Point())) continue;
      const TilePath path = tile_path(page, pieces, copy.cover_from_room);
      if (path.d.empty() || path.diameter < options.smallest) continue;
      copy.word = copies[next].word;
      copy.word.push_back(static_cast<std::uint8_t>(std::min<std::size_t>(side, 255)));
      copies.push_back(std::move(copy));
    }
  }
  return copies;
}

/// The mark of a side of the polygon: a thick line for a mirror, else its name and an arrow along it.
std::string mark_of(const Page& page, const room::GluedPolygon& polygon, const room::Room& room, std::size_t side) {
  const room::GluedSide& own = polygon.sides[side];
  const room::Wall& wall = room.walls[side];
  const geometry::Space space = polygon.space;
  const auto at = [&](double s) { return geometry::point_along(space, wall.start, wall.along, s * wall.length); };
  if (own.kind == room::SideKind::mirror) {
    const Piece piece{at(0), at(0.5), at(1), wall.line};
    return "<path fill=\"none\" stroke=\"" + std::string(kInk) + "\"" + attribute("stroke-width", 5 * page.unit) + " d=\"" +
           open_path(page, piece) + "\"/>\n";
  }
  const Complex middle = on_page(page, at(0.5)), ahead = on_page(page, at(0.52)) - on_page(page, at(0.48));
  const double length = math::abs(on_page(page, at(1)) - on_page(page, at(0)));
  const double size = std::clamp(0.11 * length, 3 * page.unit, 13 * page.unit);
  // Of two sides that are glued with their orientation kept the second runs against the border, of a glide along it.
  const bool is_second = own.partner < static_cast<int>(side);
  const Complex along = (is_second && own.kind == room::SideKind::pair ? -1.0 : 1.0) * ahead / math::abs(ahead),
                across = along * Complex(0, 1);
  const Complex tip = middle + size * along, left = middle - 0.8 * size * along + 0.7 * size * across,
                right = middle - 0.8 * size * along - 0.7 * size * across;
  const auto text = [](const Complex& z) { return coordinate(z.real()) + " " + coordinate(z.imag()); };
  std::string out = "<path fill=\"" + std::string(own.kind == room::SideKind::glide ? kPaper : kInk) + "\" stroke=\"" + kInk + "\"" +
                    attribute("stroke-width", 1.2 * page.unit) + " d=\"M" + text(tip) + "L" + text(left) + "L" + text(right) + "Z\"/>\n";
  const Complex centre = on_page(page, Point()), inward = (centre - middle) / std::max(math::abs(centre - middle), 1e-9);
  const Complex place = middle + 2.1 * size * inward;
  return out + "<text" + attribute("x", place.real()) + attribute("y", place.imag() + 0.5 * size) + attribute("font-size", 1.5 * size) +
         " text-anchor=\"middle\" font-family=\"Georgia, 'Times New Roman', serif\" font-style=\"italic\" fill=\"" + kInk + "\">" +
         own.name + "</text>\n";
}

}  // namespace

RoomDrawing draw_glued(const std::string& title, const room::GluedPolygon& polygon, const RoomPicture& picture) {
  const room::Room room = room_of(polygon);
  SvgOptions look = picture.look;
  look.smallest = picture.fill.smallest;
  look.labels = false;  // those of rooms: orders of corners and numbers of walls
  const double caption = picture.look.labels ? caption_height(picture.width) : 0;
  const Page page = make_room_page(room, picture.chart, {picture.width, picture.height, caption, !picture.look.labels});
  for (Polyline& line : look.motif)
    for (Complex& z : line) z *= std::conj(page.turn);
  if (!look.motif.empty()) look.motif = placed_motif(look.motif, room);
  driver::Tiling tiling;
  tiling.title = title;
  tiling.room = room;
  tiling.copies = copies_on(page, room, room::crossing_isometries(polygon), picture.fill);
  tiling.model = picture.chart == Chart::klein ? driver::Tiling::Model::klein : driver::Tiling::Model::disk;
  tiling.coloring = picture.coloring;
  tiling.room_from_eye = geometry::identity(room.space);
  RoomDrawing drawing;
  drawing.copies = tiling.copies.size();
  drawing.width = page.width;
  drawing.height = page.height;
  drawing.svg = draw_tiling(tiling, page, caption, look);
  std::string marks;
  if (picture.look.labels)
    for (std::size_t side = 0; side < polygon.sides.size(); ++side) marks += mark_of(page, polygon, room, side);
  if (picture.look.labels) marks += caption_line(title, page, room.space);
  drawing.svg.insert(drawing.svg.rfind("</svg>"), marks);
  return drawing;
}

}  // namespace orbc::svg
