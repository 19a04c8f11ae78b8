#include "compiler/bend/screen_size.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "compiler/cover/copy.h"

using namespace orbc;

TEST_CASE("beyond the antipode a thing is seen as large as its nearest point on that way allows", "[bend]") {
  place::Camera eye;
  eye.room_from_eye = geometry::identity(geometry::Space::spherical);
  eye.z = 0.4;
  const bend::ScreenSize detail(eye, {});
  bend::BoundingCylinder cylinder;
  cylinder.centre = geometry::translation_by(geometry::Space::spherical, 2.9, 0) * geometry::Point();
  cylinder.radius = 0.2, cylinder.low = 0, cylinder.high = 0.8;
  cover::Copy copy;
  copy.cover_from_room = geometry::identity(geometry::Space::spherical);
  const double here = detail.smaller_side_px(copy, cylinder);  // its height, over 2.9 - 0.2
  copy.sheet = 1;                                              // over 2π - (2.9 + 0.2), the other way round
  CHECK(detail.smaller_side_px(copy, cylinder) / here == Approx(2.7 / (2 * std::numbers::pi - 3.1)));
  copy.sheet = 2;
  CHECK(detail.smaller_side_px(copy, cylinder) / here == Approx(2.7 / (2 * std::numbers::pi + 2.7)));
}
