// Pictures of whole tilings: pages, filling, motifs, path data.
#include <catch2/catch.hpp>
#include <set>

#include "compiler/cover/enumerate.h"
#include "compiler/geometry/chart.h"
#include "compiler/notation/parse.h"
#include "compiler/room/cuts.h"
#include "compiler/room/realise.h"
#include "exporters/svg/draw_room.h"
#include "exporters/svg/letters.h"

using namespace orbc;

namespace {

using Point2 = std::complex<double>;

room::Room realised(const char* notation) { return room::realise(notation::parse(notation).value()).value(); }

double signed_area(const svg::Polyline& line) {
  double area = 0;
  for (std::size_t i = 0; i < line.size(); ++i) area += std::imag(std::conj(line[i]) * line[(i + 1) % line.size()]) / 2;
  return area;
}

bool holds(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

std::size_t count_of(const std::string& text, std::string_view part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("path data are read with all their commands", "[svg]") {
  const auto square = svg::read_path_data("M0 0h2v2H0z").value();
  REQUIRE(square.size() == 1);
  CHECK(square[0] == svg::Polyline{{0, 0}, {2, 0}, {2, -2}, {0, -2}});
  CHECK(svg::read_path_data("M0 0L1 0 1 1ZM5 5L6 5L6 6Z").value().size() == 2);
  // Curves end where they say; a half circle of radius 1 stays at distance 1 from its middle.
  for (const char* text : {"M0 0C0 1 1 1 1 0", "M0 0Q.5 1 1 0", "M0 0Q.25 .5 .5 0T1 0", "M0 0C0 1 .5 1 .5 0S1 -1 1 0", "M0 0c0 1 1 1 1 0"})
    CHECK(std::abs(svg::read_path_data(text).value()[0].back() - Point2(1, 0)) < 1e-12);
  for (const auto& [text, top] : {std::pair{"M-1 0A1 1 0 0 1 1 0", 1.0}, {"M-1 0A1 1 0 0 0 1 0", -1.0}, {"M-1 0a1,1 0 012 0", 1.0}}) {
    const auto half = svg::read_path_data(text).value()[0];
    double farthest = 0;
    for (const Point2& z : half) {
      CHECK(std::abs(z) == Approx(1));
      if (std::fabs(z.imag()) > std::fabs(farthest)) farthest = z.imag();
    }
    CHECK(farthest == Approx(top));
  }
  const auto large = svg::read_path_data("M1 0A1 1 0 1 1 0 1").value()[0];
  CHECK(large.size() > 30);
}

TEST_CASE("what is no path is refused, with what stands there", "[svg]") {
  for (const char* text : {"", " ", "L1 1", "M", "M0", "M0 0", "M0 0L", "M0 0L1", "M0 0X1 1", "hello", "M0 0L1 nan", "M0 0L1e999 1",
                           "M0 0A1 1 0 2 0 1 1", "M0 0C1 1 2 2"}) {
    CAPTURE(text);
    const auto read = svg::read_path_data(text);
    REQUIRE_FALSE(read);
    CHECK(read.error().front().code == "svg.bad-path");
  }
  std::string long_path = "M0 0";
  for (int i = 0; i < 30000; ++i) long_path += "L1 1";
  CHECK(svg::read_path_data(long_path).error().front().message.find("20000") != std::string::npos);
  CHECK(svg::read_motif("é").error().front().code == "svg.bad-path");
  CHECK(svg::read_motif("?").error().front().code == "svg.bad-motif");
  CHECK(svg::read_motif("<svg><rect/></svg>").error().front().code == "svg.bad-motif");
  CHECK(svg::read_motif("<svg xmlns='x'><path fill='red' d='M0 0L1 0L1 1Z'/><path d=\"M0 0L2 0L2 2Z\"/></svg>").value().size() == 2);
}

TEST_CASE("there is an outline for each letter", "[svg]") {
  for (const char c : std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZpbdq")) {
    CAPTURE(c);
    const auto outlines = svg::letter_outlines(c);
    REQUIRE_FALSE(outlines.empty());
    for (const svg::Polyline& outline : outlines)
      for (const Point2& z : outline) CHECK((std::isfinite(z.real()) && std::abs(z) < 2));
  }
  CHECK(svg::letter_outlines('1').empty());
}

TEST_CASE("a motif stands in the room, close to a wall, and turns over in a mirror", "[svg]") {
  const char* notation = GENERATE("*", "*55", "*235", "*333", "*2222", "**", "*22∞", "*237", "*22222", "*23456789(10)(11)");
  CAPTURE(notation);
  const room::Room room = realised(notation);
  const svg::Motif motif = svg::placed_motif(svg::read_motif("F").value(), room);
  double nearest = 1e9, space = 1e9;
  for (const room::Wall& wall : room.walls) {
    space = std::min(space, geometry::signed_distance(room.space, wall.line, geometry::Point()));
    for (const svg::Polyline& line : motif)
      for (const Point2& z : line)
        nearest = std::min(nearest, geometry::signed_distance(room.space, wall.line, geometry::point_from_disk(room.space, z)));
  }
  CHECK(nearest > 0.11 * space);
  CHECK(nearest < 0.14 * space);
  for (std::size_t wall = 0; wall < room.walls.size(); ++wall) {
    if (!room.walls[wall].reflects) continue;
    const geometry::Isometry mirror = room::reflection_in_wall(room, static_cast<int>(wall));
    for (const svg::Polyline& line : motif) {
      svg::Polyline image;
      for (const Point2& z : line) {
        const geometry::Point p = mirror * geometry::point_from_disk(room.space, z);
        image.push_back(geometry::disk_from_point(room.space, p));
      }
      // Of the half sphere the image holds the point at infinity.
      if (room.walls.size() > 1) CHECK(signed_area(line) * signed_area(image) < 0);
    }
  }
}

/// How often closed lines run around a point, counter-clockwise.
static int winding(const std::vector<svg::Polyline>& lines, Point2 at) {
  double angle = 0;
  for (const svg::Polyline& line : lines)
    for (std::size_t i = 0; i < line.size(); ++i) angle += std::arg((line[(i + 1) % line.size()] - at) / (line[i] - at));
  return static_cast<int>(std::lround(angle / (2 * 3.14159265358979323846)));
}

/// The distance from a point to the nearest edge of closed lines.
static double distance_to(const std::vector<svg::Polyline>& lines, Point2 at) {
  double least = 1e9;
  for (const svg::Polyline& line : lines)
    for (std::size_t i = 0; i < line.size(); ++i) {
      const Point2 a = line[i], b = line[(i + 1) % line.size()] - a;
      const double t = std::norm(b) > 0 ? std::clamp((std::conj(b) * (at - a)).real() / std::norm(b), 0.0, 1.0) : 0;
      least = std::min(least, std::abs(at - a - t * b));
    }
  return least;
}

TEST_CASE("a motif fills on the page what it fills in the room, around the antipode and behind the horizon as well", "[svg]") {
  const char* notation = GENERATE("*", "*33", "*222", "*235", "*333", "*22222");
  const svg::Chart chart = GENERATE(svg::Chart::disk, svg::Chart::klein);
  CAPTURE(notation, static_cast<int>(chart));
  const room::Room room = realised(notation);
  const svg::Page page = svg::make_room_page(room, chart, {600, 0, 0, false});
  const svg::Motif motif = svg::placed_motif(svg::read_motif("F").value(), room);
  const double inside = std::tanh(room.inradius / 2);  // about as wide in the disk chart as the circle that touches the walls
  int shown = 0, filled = 0, alone = 0;
  for (const cover::Copy& copy : svg::fill(room, page, {4, 100000}).copies) {
    const svg::MotifPath path = svg::motif_path(page, motif, copy.cover_from_room);
    alone += path.is_alone ? 1 : 0;
    const std::vector<svg::Polyline> outlines = path.d.empty() ? std::vector<svg::Polyline>{} : svg::read_path_data(path.d).value();
    std::vector<svg::Polyline> bent;  // the outlines where they are exactly: what is thinner than a pixel is left out of the path
    for (const svg::Polyline& line : motif) {
      bent.emplace_back();
      for (const Point2& z : line)
        bent.back().push_back(std::conj(svg::on_page(page, copy.cover_from_room * geometry::point_from_disk(room.space, z))));
    }
    for (int i = 0; i < 60; ++i) {  // a spiral of points
      const Point2 z = std::polar(inside * std::sqrt(i / 60.0), 2.399963 * i);
      const geometry::Point p = copy.cover_from_room * geometry::point_from_disk(room.space, z);
      if (room.space == geometry::Space::spherical && p.w < (page.straight ? 0.46 : -0.5)) continue;  // beyond the frame
      const Point2 at = std::conj(svg::on_page(page, p));                                             // path data is read with y up
      if (distance_to(outlines, at) < 0.3 || distance_to(bent, at) < 0.3) continue;
      ++shown;
      filled += winding(motif, z) != 0 ? 1 : 0;
      CHECK((winding(outlines, at) != 0) == (winding(motif, z) != 0));
    }
  }
  CHECK(shown > 40);
  CHECK(filled > 5);
  CHECK(alone <= 1);  // one copy at most holds the antipode
  if (notation == std::string("*") && chart == svg::Chart::disk) CHECK(alone == 1);
}

/// Whether the middle of a copy or a point of its outline lies on the page. The box of a large copy may overlap a page that the copy
/// misses.
static bool shows_a_point(const svg::Page& page, const std::vector<svg::Piece>& pieces, const geometry::Isometry& cover_from_room) {
  std::vector<geometry::Point> points = {geometry::Point()};
  for (const svg::Piece& piece : pieces) points.insert(points.end(), {piece.from, piece.middle});
  return std::any_of(points.begin(), points.end(), [&](const geometry::Point& p) {
    const std::complex<double> at = svg::on_page(page, cover_from_room * p);
    return !svg::is_outside(page, {at.real(), at.imag(), at.real(), at.imag()});
  });
}

TEST_CASE("a page is filled with all copies that are not too small", "[svg]") {
  const char* notation = GENERATE("*237", "*22222", "*2323", "*3333");
  const svg::Chart chart = GENERATE(svg::Chart::disk, svg::Chart::klein, svg::Chart::half_plane);
  CAPTURE(notation, static_cast<int>(chart));
  const room::Room room = realised(notation);
  const svg::Page page = svg::make_room_page(room, chart, {150, 0, 0, false});
  const double smallest = 4;
  std::set<std::string> filled;
  const svg::Filled result = svg::fill(room, page, {smallest, 100000});
  CHECK(result.notes.empty());
  for (const cover::Copy& copy : result.copies) CHECK(filled.insert(cover::to_string(copy.word)).second);
  // The same by visiting every copy up to a length that reaches far beyond.
  const std::vector<svg::Piece> pieces = svg::outline_pieces(room);
  const int length = room.walls.size() == 3 ? 34 : 9;
  const cover::Automaton automaton(room.orbifold, length);
  std::size_t seen = 0;
  cover::enumerate(automaton, room::generators(room), length, [&](const cover::Element& element, const geometry::Isometry& map) {
    const svg::Box box = svg::box_on_page(page, pieces, map);
    if (std::max(box.right - box.left, box.bottom - box.top) < smallest || !shows_a_point(page, pieces, map)) return true;
    ++seen;
    const std::string word = cover::to_string(cover::Word(element.word.begin(), element.word.end()));
    CAPTURE(word, box.left, box.right, box.top, box.bottom);
    CHECK(filled.count(word) == 1);
    return true;
  });
  CHECK(seen > 20);
  CHECK(seen <= filled.size());
}

TEST_CASE("a flat tiling reaches the edge of its page, and a sphere is covered whole", "[svg]") {
  for (const auto& [notation, copies] : {std::pair{"*235", 120}, {"*", 2}, {"*55", 10}, {"*222", 8}}) {
    const room::Room room = realised(notation);
    CHECK(svg::fill(room, svg::make_room_page(room, svg::Chart::disk, {}), {}).copies.size() == static_cast<std::size_t>(copies));
  }
  for (const char* notation : {"*333", "*244", "*236", "*2222"}) {
    const room::Room room = realised(notation);
    const svg::Page page = svg::make_room_page(room, svg::Chart::disk, {800, 500, 0, true});
    const auto copies = svg::fill(room, page, {}).copies;
    // Every point of the window lies in one copy.
    for (double x = 3; x < 800; x += 41)
      for (double y = 3; y < 500; y += 37) {
        const Point2 z = std::conj((Point2(x, y) - page.middle) / page.scale) / page.turn;
        int holding = 0;
        for (const cover::Copy& copy : copies) {
          const geometry::Point here = inverse(copy.cover_from_room) * geometry::Point(1, z.real(), z.imag());
          bool inside = true;
          for (const room::Wall& wall : room.walls) inside = inside && value_at(wall.line, here) >= 0;
          holding += inside;
        }
        CHECK(holding == 1);
      }
  }
  const room::Room strip = realised("**"), half = realised("*22∞");
  const auto across = svg::fill(strip, svg::make_room_page(strip, svg::Chart::disk, {}), {}).copies.size();
  CHECK(across >= 9);
  CHECK(svg::fill(half, svg::make_room_page(half, svg::Chart::disk, {}), {}).copies.size() == 2 * across);
}

TEST_CASE("limits of copies are kept, and told", "[svg]") {
  for (const char* notation : {"*237", "*22(1000)", "*(1000)23", "*2222"}) {
    const room::Room room = realised(notation);
    const svg::Filled filled = svg::fill(room, svg::make_room_page(room, svg::Chart::disk, {}), {0.1, 30});
    CAPTURE(notation);
    CHECK(filled.copies.size() <= 30);
    REQUIRE(filled.notes.size() == 1);
    CHECK(filled.notes[0].code == "svg.copies-left-out");
    CHECK(filled.copies.front().word.empty());
  }
}

TEST_CASE("the border of the half-plane is met at right angles, and the room's centre lies at i", "[svg]") {
  for (const char* notation : {"*237", "*22222"}) {
    const room::Room room = realised(notation);
    const svg::Page page = svg::make_room_page(room, svg::Chart::half_plane, {});
    CHECK(std::abs(svg::on_page(page, geometry::Point()) - (page.middle - Point2(0, page.scale))) < 1e-9);
    for (const room::Wall& wall : room.walls) {
      // The circle about a point of the border through both ends goes through the middle.
      const auto at = [&](double s) {
        return svg::on_page(page, geometry::point_along(room.space, wall.start, wall.along, s)) - page.middle;
      };
      const Point2 p = at(0), m = at(wall.length / 2), q = at(wall.length);
      const double centre = (std::norm(q) - std::norm(p)) / (2 * (q.real() - p.real()));
      CHECK(std::abs(m - centre) == Approx(std::abs(p - centre)));
      CHECK(1 / svg::bend_of(page, wall.line) == Approx(std::abs(p - centre)));
    }
  }
}

TEST_CASE("own colors, lines, motif, cuts and print sizes stand in the file", "[svg]") {
  svg::RoomPicture picture;
  picture.look.colors = {"#ffffff", "#102030"};
  picture.look.line_color = "#ff0000";
  picture.look.lines = 3;
  picture.look.unit = "mm";
  picture.look.per_unit = 96 / 25.4;
  picture.look.cuts = true;
  picture.look.motif = svg::read_motif("F").value();
  picture.width = 200 * 96 / 25.4;
  const svg::RoomDrawing drawing = svg::draw_room(realised("*222222"), picture);
  CHECK(holds(drawing.svg, "width=\"200mm\""));
  CHECK(holds(drawing.svg, "viewBox=\"0 0 755.906"));
  for (const char* part : {"fill=\"#ffffff\"", "fill=\"#102030\"", "stroke=\"#ff0000\"", "fill-rule=\"nonzero\"", "cut of walls 2 and 6"})
    CHECK(holds(drawing.svg, part));
  CHECK(count_of(drawing.svg, "<title>cut of walls") == 3);
  CHECK(drawing.notes.empty());
  CHECK(svg::draw_room(realised("*222222"), picture).svg == drawing.svg);
  picture.look.labels = false;
  CHECK_FALSE(holds(svg::draw_room(realised("*222222"), picture).svg, "<text"));
  CHECK(svg::draw_room(realised("*333"), picture).notes.front().code == "svg.no-cuts");
}

TEST_CASE("cuts meet their walls at right angles, inside the room", "[svg]") {
  for (const char* notation : {"*2323", "*22222", "*222222", "*23456789(10)(11)"}) {
    const room::Room room = realised(notation);
    const auto cuts = room::cut_segments(room);
    CHECK(cuts.size() == room.walls.size() - 3);
    for (const room::CutSegment& cut : cuts) {
      const geometry::Line across = geometry::line_through(room.space, cut.from, cut.to);
      for (const int wall : cut.walls) {
        const geometry::Line& line = room.walls[static_cast<std::size_t>(wall)].line;
        CHECK(across.x * line.x + across.y * line.y - across.w * line.w == Approx(0).margin(1e-9));
      }
      CHECK(std::fabs(geometry::signed_distance(room.space, room.walls[static_cast<std::size_t>(cut.walls[0])].line, cut.from)) < 1e-9);
      CHECK(std::fabs(geometry::signed_distance(room.space, room.walls[static_cast<std::size_t>(cut.walls[1])].line, cut.to)) < 1e-9);
    }
  }
  CHECK(room::cut_segments(realised("*237")).empty());
  CHECK(room::cut_segments(realised("*2222")).empty());
}
