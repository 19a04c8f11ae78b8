#include "compiler/room/view.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "compiler/notation/parse.h"
#include "compiler/room/realise.h"

using namespace orbc;

namespace {

room::Room room_of(const std::string& notation) {
  const auto orbifold = notation::parse(notation);
  REQUIRE(orbifold);
  const auto room = room::realise(*orbifold);
  REQUIRE(room);
  return *room;
}

double degrees_to_corner(const room::Room& room, std::size_t corner) {
  const geometry::Point& at = room.corners[corner].at;
  const double off = std::fmod(std::atan2(at.y, at.x) * 180 / std::numbers::pi - room::view_direction(room) + 720, 360);
  return off > 180 ? off - 360 : off;
}

}  // namespace

TEST_CASE("a room is seen with its second widest corner a little left of the middle", "[room]") {
  for (const auto& [notation, corner] : {std::pair{"*22", 1}, {"*222", 1}, {"*235", 1}, {"*523", 2}, {"*333", 1}, {"*2323", 2},
                                         {"*22222", 1}, {"*22(10)", 1}, {"*23456789(10)(11)", 1}}) {
    INFO(notation);
    CHECK(degrees_to_corner(room_of(notation), static_cast<std::size_t>(corner)) == Approx(20).margin(1e-6));
  }
}

TEST_CASE("the strip is seen along its row of images, and every direction lies within a full turn", "[room]") {
  const room::Room strip = room_of("**");
  const geometry::Point middle = room::point_on_wall(strip, 2, strip.walls[2].length / 2);
  const double straight = std::atan2(middle.y, middle.x) * 180 / std::numbers::pi;
  CHECK(std::abs(std::remainder(room::view_direction(strip) - straight, 360)) < 10);
  for (const char* notation : {"*", "**", "*22", "*(100)(100)", "*244", "*2222", "*22222222222222222222"}) {
    const double view = room::view_direction(room_of(notation));
    CHECK(view >= 0);
    CHECK(view < 360);
  }
}
