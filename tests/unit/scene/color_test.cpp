#include "compiler/scene/color.h"

#include <catch2/catch.hpp>

using namespace orbc::scene;

TEST_CASE("there are the 148 colour names of CSS", "[scene]") {
  CHECK(color_names().size() == 148);
  for (const std::string& name : color_names()) CHECK(named_color(name));
  CHECK(*named_color("white") == Color{1, 1, 1});
  CHECK(*named_color("coral") == from_hex(0xff7f50));
  CHECK(*named_color("rebeccapurple") == from_hex(0x663399));
  CHECK(*named_color("grey") == *named_color("gray"));
  CHECK_FALSE(named_color("Coral"));
  CHECK_FALSE(named_color(""));
  CHECK_FALSE(named_color("zzz"));
}

TEST_CASE("hexadecimal colours have three or six digits", "[scene]") {
  CHECK(*parse_color("#fff") == Color{1, 1, 1});
  CHECK(*parse_color("#f80") == *parse_color("#ff8800"));
  CHECK(*parse_color("#FFeEdD") == from_hex(0xffeedd));
  for (const char* bad : {"#", "#ff", "#ffff", "#fffff", "#fffffff", "#ggg", "fff", "# fff", "##fff"}) {
    INFO(bad);
    CHECK_FALSE(parse_color(bad));
  }
}

TEST_CASE("a black body is red when warm, white near 6500 K, blue when hot", "[scene]") {
  const Color warm = color_of_temperature(2000), day = color_of_temperature(6504), hot = color_of_temperature(20000);
  CHECK(warm.r == 1);
  CHECK(warm.r > warm.g);
  CHECK(warm.g > warm.b);
  CHECK(hot.b == 1);
  CHECK(hot.b > hot.r);
  CHECK(day.r == Approx(1).margin(0.06));
  CHECK(day.g == Approx(1).margin(0.06));
  CHECK(day.b == Approx(1).margin(0.06));
  for (double kelvin = 1667; kelvin < 25000; kelvin += 1) {  // no jump where the fits meet
    const Color a = color_of_temperature(kelvin), b = color_of_temperature(kelvin + 1);
    if (std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b) > 0.01) FAIL("jump at " << kelvin);
  }
}
