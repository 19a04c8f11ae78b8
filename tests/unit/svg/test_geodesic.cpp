#include <catch2/catch.hpp>
#include <complex>
#include <cstdlib>
#include <regex>

#include "compiler/geometry/chart.h"
#include "compiler/notation/parse.h"
#include "compiler/room/realise.h"
#include "exporters/svg/draw_room.h"
#include "exporters/svg/hyperboloid.h"

namespace {

using namespace orbc;
using Complex = std::complex<double>;
using geometry::Space;

room::Room room_of(const std::string& notation) { return room::realise(notation::parse(notation).value()).value(); }

svg::Geodesic through(Space space, Complex p, Complex q) {
  return {geometry::point_from_disk(space, p), geometry::point_from_disk(space, q)};
}

/// The end points of the pieces of the first path of an SVG text: the last two numbers of each of its commands.
std::vector<Complex> path_points(const std::string& text) {
  const std::size_t begin = text.find(" d=\"") + 4;
  const std::string d = text.substr(begin, text.find('"', begin) - begin);
  std::vector<Complex> points;
  static const std::regex command("[MLA]([^MLA]*)"), number("-?[0-9.]+");
  for (std::sregex_iterator at(d.begin(), d.end(), command), end; at != end; ++at) {
    const std::string numbers = (*at)[1];
    std::vector<double> values;
    for (std::sregex_iterator n(numbers.begin(), numbers.end(), number); n != std::sregex_iterator(); ++n)
      values.push_back(std::strtod(n->str().c_str(), nullptr));
    REQUIRE(values.size() >= 2);
    points.emplace_back(values[values.size() - 2], values.back());
  }
  return points;
}

std::vector<Complex> dots(const std::string& text) {
  std::vector<Complex> points;
  static const std::regex dot("cx=\"(-?[0-9.]+)\" cy=\"(-?[0-9.]+)\"");
  for (std::sregex_iterator at(text.begin(), text.end(), dot); at != std::sregex_iterator(); ++at)
    points.emplace_back(std::strtod((*at)[1].str().c_str(), nullptr), std::strtod((*at)[2].str().c_str(), nullptr));
  return points;
}

/// Twice the area of a triangle over the square of its longest side: 0 for points on a line.
double off_line(Complex a, Complex b, Complex c) {
  const double longest = std::max({std::norm(b - a), std::norm(c - b), std::norm(c - a)});
  return std::fabs(((b - a).real() * (c - a).imag() - (b - a).imag() * (c - a).real())) / longest;
}

}  // namespace

TEST_CASE("a geodesic is straight in the Klein disk, and a circle at right angles to the rim of the Poincaré disk", "[svg]") {
  const room::Room room = room_of("*237");
  const svg::Geodesic geodesic = through(Space::hyperbolic, {0.1, 0.35}, {-0.4, 0.1});
  const svg::Page klein = svg::make_room_page(room, svg::Chart::klein, {}), disk = svg::make_room_page(room, svg::Chart::disk, {});
  const std::vector<Complex> straight = path_points(svg::geodesic_lines(klein, {geodesic}));
  REQUIRE(straight.size() > 20);
  for (const Complex& z : straight) CHECK(off_line(straight.front(), straight.back(), z) < 1e-4);
  for (const Complex& end : {straight.front(), straight.back()}) CHECK(std::abs(end - klein.middle) == Approx(klein.scale).margin(0.01));
  // The circle through p, q and the inverse of p in the unit circle: all of its points have the same distance from its centre c, and it
  // meets the rim at right angles, |c|² = 1 + r².
  const std::vector<Complex> curved = path_points(svg::geodesic_lines(disk, {geodesic}));
  const geometry::Line line = geometry::line_through(Space::hyperbolic, geodesic.from, geodesic.to);
  const Complex centre = -Complex(line.x, line.y) / line.w, on_page = disk.middle + disk.scale * std::conj(centre);
  const double radius = std::sqrt(std::norm(centre) - 1) * disk.scale;
  REQUIRE(curved.size() == straight.size());
  for (const Complex& z : curved) CHECK(std::abs(z - on_page) == Approx(radius).margin(0.01));
  CHECK(off_line(curved.front(), curved.back(), curved[curved.size() / 2]) > 0.01);
}

TEST_CASE("a geodesic of the sphere runs around it, one of the plane leaves the page on both sides", "[svg]") {
  const svg::Page sphere = svg::make_room_page(room_of("*235"), svg::Chart::disk, {});
  const std::vector<Complex> round = path_points(svg::geodesic_lines(sphere, {through(Space::spherical, {0.1, 0}, {0, 0.2})}));
  CHECK(std::abs(round.front() - round.back()) < 0.01);
  const svg::Page plane = svg::make_room_page(room_of("*632"), svg::Chart::disk, {});
  const std::vector<Complex> flat = path_points(svg::geodesic_lines(plane, {through(Space::euclidean, {0.1, 0}, {0, 0.2})}));
  CHECK(std::abs(flat.front() - flat.back()) > 2 * plane.width);
  for (const Complex& z : flat) CHECK(off_line(flat.front(), flat.back(), z) < 1e-6);
}

TEST_CASE("on the hyperboloid a ray from the lower vertex carries each point of the sheet to its place in the disk", "[svg]") {
  svg::RoomPicture picture;
  picture.chart = svg::Chart::hyperboloid;
  picture.look.labels = false;
  picture.look.geodesics = {through(Space::hyperbolic, {0.1, 0.35}, {-0.4, 0.1})};
  const svg::RoomDrawing drawing = svg::draw_room(room_of("*22222"), picture);
  CHECK(drawing.height == Approx(svg::kHyperboloidHeight * 1000));
  const std::vector<Complex> marked = dots(drawing.svg);  // in the disk and on the sheet, of each point; the vertex
  REQUIRE(marked.size() == 5);
  for (const std::size_t i : {0U, 2U}) {
    CHECK(off_line(marked[4], marked[i], marked[i + 1]) < 1e-4);
    // Parallel rays keep ratios: the sheet's point is as many times farther from the vertex as 1 + w.
    const double w = (i == 0 ? picture.look.geodesics[0].from : picture.look.geodesics[0].to).w;
    CHECK(std::abs(marked[i + 1] - marked[4]) == Approx((1 + w) * std::abs(marked[i] - marked[4])).epsilon(1e-4));
  }
  for (const Complex& z : marked) CHECK((z.imag() > 0 && z.imag() < drawing.height));
  CHECK(svg::draw_room(room_of("*22222"), picture).svg == drawing.svg);
}
