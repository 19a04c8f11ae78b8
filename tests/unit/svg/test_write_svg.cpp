#include <catch2/catch.hpp>

#include <map>
#include <numbers>
#include <regex>
#include <sstream>

#include "compiler/geometry/chart.h"
#include "compiler/notation/parse.h"
#include "compiler/room/realise.h"
#include "exporters/svg/page.h"
#include "exporters/svg/palette.h"
#include "exporters/svg/write_svg.h"

using namespace orbc;
using Complex = std::complex<double>;
using Model = driver::Tiling::Model;

namespace {

/// The room, its mirror images, and one image of each of those.
driver::Tiling tiling_of(const char* notation, Model model = Model::disk) {
  const Result<notation::Orbifold> orbifold = notation::parse(notation);
  REQUIRE(orbifold.has_value());
  const Result<room::Room> room = room::realise(*orbifold);
  REQUIRE(room.has_value());
  driver::Tiling tiling;
  tiling.title = notation;
  tiling.room = *room;
  tiling.model = model;
  cover::Copy base;
  base.cover_from_room = geometry::identity(room->space);
  tiling.copies.push_back(base);
  const std::size_t walls = room->walls.size();
  for (std::size_t i = 0; i < walls; ++i) {
    cover::Copy copy;
    copy.cover_from_room = room::reflection_in_wall(*room, static_cast<int>(i));
    copy.word = {static_cast<std::uint8_t>(i)};
    copy.bounces = 1;
    tiling.copies.push_back(copy);
    if (walls == 1) break;
    const std::size_t next = (i + 1) % walls;
    copy.cover_from_room = copy.cover_from_room * room::reflection_in_wall(*room, static_cast<int>(next));
    copy.word.push_back(static_cast<std::uint8_t>(next));
    copy.bounces = 2;
    tiling.copies.push_back(copy);
  }
  return tiling;
}

struct Arc {
  Complex from, to;
  double radius = 0;  // 0 = straight
  bool large = false, sweep = false;
};

std::vector<Arc> arcs_of(const std::string& d) {
  std::vector<Arc> arcs;
  Complex at;
  static const std::regex command("([MLA])([^MLAZ]*)");
  for (std::sregex_iterator it(d.begin(), d.end(), command), end; it != end; ++it) {
    std::istringstream in((*it)[2].str());
    Arc arc;
    double x = 0, y = 0, r2 = 0, turn = 0;
    if ((*it)[1] == "A") in >> arc.radius >> r2 >> turn >> arc.large >> arc.sweep;
    in >> x >> y;
    arc.from = at, arc.to = at = {x, y};
    if ((*it)[1] != "M") arcs.push_back(arc);
  }
  return arcs;
}

/// The centre that SVG gives an arc (SVG 1.1, F.6.5, for circles).
Complex center_of(const Arc& arc) {
  const Complex half = (arc.to - arc.from) / 2.0;
  const double height = std::sqrt(std::max(0.0, arc.radius * arc.radius - std::norm(half)));
  return arc.from + half + Complex(0, arc.large == arc.sweep ? -1 : 1) * height * half / std::abs(half);
}

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("walls in the Poincaré disk are arcs at right angles to its rim", "[svg]") {
  for (const char* notation : {"*237", "*22222", "*23456789(10)(11)"}) {
    const driver::Tiling tiling = tiling_of(notation);
    const std::vector<svg::Piece> pieces = svg::outline_pieces(tiling.room);
    const svg::Page page = svg::make_page(tiling, pieces, 100000);
    std::size_t seen = 0;
    for (const cover::Copy& copy : tiling.copies) {
      for (const Arc& arc : arcs_of(svg::tile_path(page, pieces, copy.cover_from_room).d)) {
        if (arc.radius == 0 || std::abs(arc.to - arc.from) < 500) continue;
        const double d2 = std::norm(center_of(arc) - page.middle) / (page.scale * page.scale), r = arc.radius / page.scale;
        CHECK(d2 == Approx(1 + r * r).epsilon(1e-3));
        ++seen;
      }
    }
    CHECK(seen > tiling.copies.size());
  }
}

TEST_CASE("walls of the sphere are circles that cross the equator at opposite points", "[svg]") {
  for (const char* notation : {"*235", "*22", "*33", "*227"}) {
    const driver::Tiling tiling = tiling_of(notation);
    const std::vector<svg::Piece> pieces = svg::outline_pieces(tiling.room);
    const svg::Page page = svg::make_page(tiling, pieces, 100000);
    for (const cover::Copy& copy : tiling.copies) {
      const std::vector<Arc> arcs = arcs_of(svg::tile_path(page, pieces, copy.cover_from_room).d);
      for (std::size_t i = 0; i < pieces.size() && i < arcs.size(); ++i) {
        if (arcs[i].radius == 0) continue;
        const double d2 = std::norm(center_of(arcs[i]) - page.middle) / (page.scale * page.scale), r = arcs[i].radius / page.scale;
        CHECK(d2 + 1 == Approx(r * r).epsilon(1e-3));
      }
    }
  }
}

TEST_CASE("an arc passes through the middle of its wall, also when it is the greater one", "[svg]") {
  // A wall of the sphere that runs closely past the antipode of the centre: most of its circle on the page.
  const geometry::Space s2 = geometry::Space::spherical;
  const geometry::Isometry away = geometry::translation_by(s2, 0, std::numbers::pi - 0.05);
  const geometry::Point start = away * geometry::point_from_log(s2, {0.6, 0}), end = away * geometry::point_from_log(s2, {-0.6, 0});
  const svg::Piece there{start, geometry::midpoint(s2, start, end), end, geometry::line_through(s2, start, end)};
  const svg::Piece back{end, there.middle, start, geometry::reversed(there.line)};
  svg::Page page;
  page.space = s2, page.scale = 1000, page.frame = 100;
  const std::vector<Arc> arcs = arcs_of(svg::tile_path(page, {there, back}, geometry::identity(s2)).d);
  REQUIRE(arcs.size() == 2);
  for (const Arc& arc : arcs) {
    CHECK(arc.large);
    CHECK(std::abs(svg::on_page(page, there.middle) - center_of(arc)) == Approx(arc.radius).epsilon(1e-3));
  }
  CHECK(arcs[0].sweep != arcs[1].sweep);
}

TEST_CASE("the hemisphere is a disk and its image the ring around it", "[svg]") {
  const std::string text = svg::write_svg(tiling_of("*"))[0].bytes;
  const std::regex path("<path d=\"([^\"]*)\"><title>([^<]*)</title>");
  std::map<std::string, std::string> paths;
  for (std::sregex_iterator it(text.begin(), text.end(), path), end; it != end; ++it) paths[(*it)[2].str()] = (*it)[1].str();
  REQUIRE(paths.size() == 2);
  CHECK(std::count(paths["the room"].begin(), paths["the room"].end(), 'M') == 1);
  CHECK(std::count(paths["1"].begin(), paths["1"].end(), 'M') == 2);
  CHECK(contains(text, "fill-rule=\"evenodd\""));
}

TEST_CASE("klein and plane pictures have straight walls", "[svg]") {
  for (const char* notation : {"*22222", "*235", "*333", "*2222"}) {
    const driver::Tiling tiling = tiling_of(notation, Model::klein);
    const std::vector<svg::Piece> pieces = svg::outline_pieces(tiling.room);
    const svg::Page page = svg::make_page(tiling, pieces, 1000);
    for (const cover::Copy& copy : tiling.copies) CHECK_FALSE(contains(svg::tile_path(page, pieces, copy.cover_from_room).d, "A"));
  }
}

TEST_CASE("the sphere's near half is cut from the frame, whatever the room", "[svg]") {
  for (const char* notation : {"*", "*22", "*33", "*222", "*235"}) {
    const driver::Tiling tiling = tiling_of(notation, Model::klein);
    const std::vector<svg::Piece> pieces = svg::outline_pieces(tiling.room);
    const svg::Page page = svg::make_page(tiling, pieces, 1000);
    CHECK(svg::tile_path(page, pieces, geometry::identity(tiling.room.space)).diameter > 10);
    CHECK(contains(svg::write_svg(tiling)[0].bytes, "</svg>"));
  }
  const driver::Tiling hemisphere = tiling_of("*", Model::klein);
  const std::vector<svg::Piece> pieces = svg::outline_pieces(hemisphere.room);
  CHECK(svg::tile_path(svg::make_page(hemisphere, pieces, 1000), pieces, hemisphere.copies[1].cover_from_room).d.empty());
}

TEST_CASE("pictures carry title, description, orders and walls", "[svg]") {
  const std::string text = svg::write_svg(tiling_of("*2 3 12"))[0].bytes;
  CHECK(contains(text,
                 "<title>*2 3 12</title>\n<desc>The mirror room *2 3 12 and its 7 drawn copies; hyperbolic plane, Poincaré disk. The room "
                 "itself is orange"));
  for (const char* label : {">12</text>", ">3</text>", ">2</text>", ">1</text>"}) CHECK(contains(text, label));
  svg::SvgOptions plain;
  plain.labels = plain.tooltips = false;
  const std::string bare = svg::write_svg(tiling_of("*2 3 12"), plain)[0].bytes;
  CHECK_FALSE(contains(bare, "<text"));
  CHECK(bare.find("<title>", bare.find("<title>") + 1) == std::string::npos);
}

TEST_CASE("titles are escaped", "[svg]") {
  driver::Tiling tiling = tiling_of("*333");
  tiling.title = "a<b>&\"c\"\n\xff";
  CHECK(contains(svg::write_svg(tiling)[0].bytes, "<title>a&lt;b&gt;&amp;\"c\" \xef\xbf\xbd</title>"));
}

TEST_CASE("the strip has no orders to show", "[svg]") {
  CHECK_FALSE(contains(svg::write_svg(tiling_of("**"))[0].bytes, "<circle"));
}

TEST_CASE("copies on further sheets and copies too small to see are left out", "[svg]") {
  driver::Tiling tiling = tiling_of("*333");
  const std::string all = svg::write_svg(tiling)[0].bytes;
  cover::Copy copy = tiling.copies[1];
  copy.sheet = 1;
  tiling.copies.push_back(copy);
  CHECK(svg::write_svg(tiling)[0].bytes == all);
  svg::SvgOptions large_only;
  large_only.smallest = 1e6;
  CHECK(contains(svg::write_svg(tiling, large_only)[0].bytes, " 0 drawn copies"));
}

TEST_CASE("the room, mirror images and their images differ in colour, by parity and by length", "[svg]") {
  const driver::Tiling tiling = tiling_of("*22222");
  for (const auto coloring : {driver::Tiling::Coloring::parity, driver::Tiling::Coloring::length}) {
    const std::string a = svg::fill_of(tiling.copies[0], 2, coloring), b = svg::fill_of(tiling.copies[1], 2, coloring),
                      c = svg::fill_of(tiling.copies[2], 2, coloring);
    for (const std::string& color : {a, b, c}) CHECK(std::regex_match(color, std::regex("#[0-9a-f]{6}")));
    CHECK(a == svg::kBase);
    CHECK(a != b);
    CHECK(b != c);
  }
}

TEST_CASE("coordinates have three digits and no more than they need", "[svg]") {
  CHECK(svg::coordinate(1) == "1");
  CHECK(svg::coordinate(0.1234567) == "0.123");
  CHECK(svg::coordinate(-0.0001) == "0");
  CHECK(svg::coordinate(-12.5) == "-12.5");
  CHECK(svg::coordinate(1e300).size() == 301);
}

TEST_CASE("the same tiling gives the same bytes", "[svg]") {
  CHECK(svg::write_svg(tiling_of("*237"))[0].bytes == svg::write_svg(tiling_of("*237"))[0].bytes);
}

TEST_CASE("a copy is cut to its wedge, in every space and chart", "[svg]") {
  const char* notation = GENERATE("*333", "*22222", "*235");
  const Model model = GENERATE(Model::disk, Model::klein);
  driver::Tiling tiling = tiling_of(notation, model);
  tiling.copies.resize(2);
  const auto whole = svg::write_svg(tiling).front().bytes;
  // The image in wall 1, seen from the centre of the room, left and right of the direction to the middle of its wall.
  const auto& wall = tiling.room.walls[0];
  const auto middle = geometry::point_along(tiling.room.space, wall.start, wall.along, wall.length / 2);
  tiling.room_from_eye = geometry::identity(tiling.room.space);
  const double rho = std::hypot(middle.x, middle.y), c = middle.x / rho, s = middle.y / rho;
  const std::vector<svg::Piece> pieces = svg::outline_pieces(tiling.room);
  cover::Copy left = tiling.copies[1], right = left;
  left.wedge = cover::Wedge{{c, s}, {-s, c}};
  right.wedge = cover::Wedge{{s, -c}, {c, s}};
  double sum = 0;
  for (const cover::Copy& half : {left, right}) {
    const auto seen = svg::seen_pieces(tiling.room.space, pieces, half, tiling.room_from_eye);
    REQUIRE(seen.size() >= 3);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const auto &p = seen[i].to, &q = seen[(i + 1) % seen.size()].from;   // closed, and on its lines
      CHECK(std::hypot(p.x - q.x, p.y - q.y) < 1e-12);
      CHECK(std::abs(value_at(seen[i].line, seen[i].middle)) < 1e-12);
      sum += seen[i].from.x * seen[i].to.y - seen[i].from.y * seen[i].to.x;   // about the border; the cut counts once each way
    }
  }
  double all = 0;
  for (const svg::Piece& p : svg::seen_pieces(tiling.room.space, pieces, tiling.copies[1], tiling.room_from_eye))
    all += p.from.x * p.to.y - p.from.y * p.to.x;
  if (tiling.room.space == geometry::Space::euclidean) CHECK(sum == Approx(std::abs(all)));
  tiling.copies[1] = left;
  const auto cut = svg::write_svg(tiling).front().bytes;
  CHECK(cut != whole);
  CHECK(cut.find("cut to what the eye sees") != std::string::npos);
  // A wedge that misses the copy shows nothing of it.
  cover::Copy missed = left;
  missed.wedge = cover::Wedge{{-c, -s}, {-c + 1e-3 * s, -s - 1e-3 * c}};
  if (tiling.room.space != geometry::Space::spherical)
    CHECK(svg::seen_pieces(tiling.room.space, pieces, missed, tiling.room_from_eye).empty());
}

TEST_CASE("storeys above each other are one room from above", "[svg]") {
  driver::Tiling tiling = tiling_of("*2222");
  const auto one = svg::write_svg(tiling).front().bytes;
  cover::Copy above = tiling.copies.front();
  above.storey = {1, -1, 2};
  tiling.copies.push_back(above);
  CHECK(svg::write_svg(tiling).front().bytes == one);
}
