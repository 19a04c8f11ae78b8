// Polygons of symbols, held to their coordinates; counts held to Steinberg's formula and to numbers of other methods.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "compiler/geometry/chart.h"
#include "compiler/geometry/line.h"
#include "compiler/notation/growth.h"
#include "compiler/notation/parse.h"
#include "compiler/room/count_elements.h"

using namespace orbc;
using geometry::Point;
using geometry::Space;
using room::GluedPolygon;

namespace {

GluedPolygon polygon_of(const std::string& text) {
  INFO(text);
  const auto symbol = notation::parse_symbol(text);
  REQUIRE(symbol);
  const auto polygon = room::glued_polygon(*symbol);
  REQUIRE(polygon);
  return *polygon;
}

std::vector<Integer> counted(const std::string& text, int length) { return room::elements_per_length(polygon_of(text), length); }

std::vector<Integer> integers(std::initializer_list<long> values) { return {values.begin(), values.end()}; }

void check_coordinates(const GluedPolygon& p) {
  const std::size_t n = p.sides.size();
  std::vector<Point> corners;
  for (const auto& z : p.corners) corners.push_back(geometry::point_from_disk(p.space, z));
  for (std::size_t i = 0; i < n; ++i) {
    const Point &before = corners[(i + n - 1) % n], &at = corners[i], &after = corners[(i + 1) % n];
    CHECK(geometry::distance(p.space, at, after) == Approx(p.sides[i].length).epsilon(1e-9).margin(1e-12));
    const geometry::Line side = geometry::line_through(p.space, at, after);
    CHECK(std::fabs(geometry::signed_distance(p.space, side, Point())) == Approx(p.inradius).epsilon(1e-7).margin(1e-9));
    // The interior angle, between the directions to both neighbours.
    const geometry::Tangent u = geometry::direction_to(p.space, at, after), v = geometry::direction_to(p.space, at, before);
    const double k = geometry::curvature(p.space), cosine = u.x * v.x + u.y * v.y + k * u.w * v.w;
    CHECK(cosine == Approx(std::cos(2 * std::numbers::pi / p.corner_fraction[i])).margin(1e-6));
    // What is glued fits.
    CHECK(p.sides[static_cast<std::size_t>(p.sides[i].partner)].length == Approx(p.sides[i].length).epsilon(1e-13));
    CHECK(p.sides[static_cast<std::size_t>(p.sides[i].partner)].partner == static_cast<int>(i));
  }
  CHECK(p.relator_residual < 1e-30);
}

}  // namespace

TEST_CASE("polygons have the sides, angles and inscribed circle that they tell, and their relators close", "[room]") {
  for (const char* text :
       {"o",    "xx",  "22*", "2222", "333", "442", "632",  "*x",    "22x", "2*22", "3*3", "4*2", "**",     "332",
        "532",  "2*5", "4x",  "237",  "oo",  "o23", "*o23", "*2**3", "2*x", "xxxx", "57x", "***", "*22*33", "oo3337*2423*4443",
        "*237", "*532"}) {
    CAPTURE(text);
    check_coordinates(polygon_of(text));
  }
}

TEST_CASE("every good symbol of few features has a polygon whose relators close", "[room]") {
  const std::vector<std::string> cones{"", "2", "3", "7", "(12)", "22", "23", "2(11)", "345"},
      boundaries{"", "*", "*2", "*35", "*(12)", "**", "*2*3", "*22*4"}, ends{"", "x", "xx"}, handles{"", "o"};
  int good = 0;
  for (const std::string& handle : handles)
    for (const std::string& cone : cones)
      for (const std::string& boundary : boundaries)
        for (const std::string& end : ends) {
          const std::string text = handle + cone + boundary + end;
          if (text.empty() || text == "*") continue;
          CAPTURE(text);
          const auto symbol = notation::parse_symbol(text);
          REQUIRE(symbol);
          const auto polygon = room::glued_polygon(*symbol);
          const bool is_bad = !notation::why_bad(*symbol).empty(), has_one_side = text == "*2" || text == "*(12)";
          REQUIRE(polygon.has_value() == !(is_bad || has_one_side));
          if (!polygon) continue;
          ++good;
          CHECK(polygon->relator_residual < 1e-30);
          // Gauss and Bonnet: the excess of the angles is 2πχ.
          Rational angles = 0;
          for (const int fraction : polygon->corner_fraction) angles += Rational(2, fraction);
          const int n = static_cast<int>(polygon->sides.size());
          CHECK(angles - Rational(n - 2) == Rational(2) * notation::euler_characteristic(*symbol));
        }
  CHECK(good > 400);
}

TEST_CASE("finite groups have 2 over the Euler characteristic elements", "[room]") {
  for (const char* text : {"x", "22", "55", "5*", "2*3", "3*2", "4x", "332", "432", "532", "22(7)", "3x", "*532", "*22(9)"}) {
    CAPTURE(text);
    Integer all = 0;
    for (const Integer& count : counted(text, 100)) all += count;
    CHECK(Rational(all) == Rational(2) / notation::euler_characteristic(*notation::parse_symbol(text)));
  }
}

TEST_CASE("words of mirrors are counted as Steinberg's formula counts them", "[room]") {
  for (const char* text : {"*237", "*22222", "*632", "*2323", "*2222", "*334"}) {
    CAPTURE(text);
    CHECK(counted(text, 20) == notation::copies_per_length(notation::parse(text).value(), 20));
  }
}

TEST_CASE("words of doors are counted to any length", "[room]") {
  // Numbers of other methods; the torus and the Klein bottle grow by four, as squares around a square do.
  CHECK(counted("o", 6) == integers({1, 4, 8, 12, 16, 20, 24}));
  CHECK(counted("xx", 6) == integers({1, 4, 8, 12, 16, 20, 24}));
  CHECK(counted("237", 12) == integers({1, 5, 9, 16, 24, 33, 48, 67, 92, 129, 178, 246, 342}));
  CHECK(counted("*2*2", 10) == integers({1, 6, 24, 90, 336, 1254, 4680, 17466, 65184, 243270, 907896}));
  CHECK(counted("o2", 9) == integers({1, 5, 20, 70, 245, 860, 3015, 10570, 37060, 129935}));
  CHECK(counted("*2**3", 5) == integers({1, 11, 97, 842, 7309, 63447}));
  // Genus 2: 8 z + … by Cannon's series (1 + 2z + 2z² + 2z³ + z⁴)/(1 − 6z − 6z² − 6z³ + z⁴).
  std::vector<long> genus{1};
  const long numerator[] = {1, 2, 2, 2, 1}, denominator[] = {1, -6, -6, -6, 1};
  for (std::size_t i = 1; i <= 12; ++i) {
    long value = i < 5 ? numerator[i] : 0;
    for (std::size_t j = 1; j <= std::min<std::size_t>(4, i); ++j) value -= denominator[j] * genus[i - j];
    genus.push_back(value);
  }
  CHECK(counted("oo", 12) == std::vector<Integer>(genus.begin(), genus.end()));
}
