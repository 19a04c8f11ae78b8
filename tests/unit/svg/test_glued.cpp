#include <catch2/catch.hpp>

#include "exporters/svg/draw_glued.h"

namespace {

using namespace orbc;

svg::RoomDrawing drawn(const std::string& text, const svg::RoomPicture& picture = {}) {
  const auto symbol = notation::parse_symbol(text);
  REQUIRE(symbol);
  const auto polygon = room::glued_polygon(*symbol);
  REQUIRE(polygon);
  return svg::draw_glued(text, *polygon, picture);
}

std::size_t times(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

}  // namespace

TEST_CASE("copies of a finite group cover the sphere, each once", "[svg]") {
  for (const auto& [text, order] :
       {std::pair{"x", 2U}, {"22", 2U}, {"55", 5U}, {"5*", 10U}, {"332", 12U}, {"4x", 8U}, {"532", 60U}, {"3*2", 24U}}) {
    CAPTURE(text);
    svg::RoomPicture picture;
    picture.fill.smallest = 0.01;
    CHECK(drawn(text, picture).copies == order);
  }
}

TEST_CASE("copies of a torus and a Klein bottle stand on the same grid of squares", "[svg]") {
  const svg::RoomDrawing torus = drawn("o"), bottle = drawn("xx");
  CHECK(torus.copies == bottle.copies);
  CHECK(torus.copies >= 25);
  // A torus has no mirror images: all its copies are light.
  CHECK(torus.svg.find("#33586f") == std::string::npos);
  CHECK(bottle.svg.find("#33586f") != std::string::npos);
}

TEST_CASE("sides are marked by what they are: an arrow with a name, a white one for a glide, a thick line for a mirror", "[svg]") {
  const std::string all = drawn("2*x").svg;  // a a, b m0 b, c c
  CHECK(times(all, "Z\"/>\n<text") == 6);
  CHECK(times(all, ">a</text>") == 2);
  CHECK(times(all, ">c</text>") == 2);
  CHECK(times(all, "<path fill=\"#fdfbf6\" stroke=\"#22303f\"") == 2);
  CHECK(times(all, "stroke-width=\"5\"") == 1);
  CHECK(all.find("2*x") != std::string::npos);
  CHECK(all == drawn("2*x").svg);
  svg::RoomPicture bare;
  bare.look.labels = false;
  CHECK(drawn("2*x", bare).svg.find("<text") == std::string::npos);
}
