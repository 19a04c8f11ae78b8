// The floors of all copies, as drawn: nothing is covered twice and nothing is missed.
#include <catch2/catch.hpp>
#include <random>

#include "tests/unit/bend/fixture.h"

using namespace orbc;
using namespace orbc::bend;
using namespace orbc::bend::test;

namespace {

/// How many floor triangles lie over (x, y), those that show their underside counted negative: slivers may turn over within the tolerance.
int covers(const BentCover& cover, double x, double y) {
  int count = 0;
  for (std::size_t i = 0; i < cover.indices.size(); i += 3) {
    const auto &a = cover.positions[cover.indices[i]], &b = cover.positions[cover.indices[i + 1]],
               &c = cover.positions[cover.indices[i + 2]];
    if (a[2] != 0 || b[2] != 0 || c[2] != 0) continue;
    if (std::min({a[0], b[0], c[0]}) > x || std::max({a[0], b[0], c[0]}) < x) continue;
    const auto side = [&](const auto& p, const auto& q) { return (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]); };
    const double s = side(a, b), t = side(b, c), u = side(c, a);
    count += (s > 0 && t > 0 && u > 0) - (s < 0 && t < 0 && u < 0);
  }
  return count;
}

/// All around and fine: what is not in the picture, or errs along the line of sight only, may overlap a little by intention.
BentCover floors(Interior& room, const std::vector<cover::Copy>& copies, place::Camera eye) {
  room.parts.resize(1);
  eye.projection = scene::Projection::panorama;
  BendOptions options;
  options.tolerance_px = 0.02;
  auto cover = bend_whole(room, plain_uv(room), copies, eye, options);
  REQUIRE(cover);
  return std::move(cover).value();
}

}  // namespace

TEST_CASE("copies tile what they reach without gap or overlap", "[bend]") {
  const auto [corners, order, length, reach] =
      GENERATE(table<int, int, int, double>({{5, 2, 5, 2.5}, {4, 2, 6, 3.0}, {3, 6, 9, 2.0}, {6, 2, 4, 2.5}}));
  auto room = regular_room(corners, order);
  const auto cover = floors(room, copies_of(room, length), eye_at(room.polygon.space, 0.2, 1.0, 0.4, 0.3, 0.1));
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  int once = 0;
  for (int i = 0; i < 400; ++i) {
    const double r = reach * std::sqrt(unit(random)), phi = 2 * std::numbers::pi * unit(random);
    once += covers(cover, r * std::cos(phi), r * std::sin(phi)) == 1;
  }
  CAPTURE(corners, order);
  CHECK(once == 400);
}

TEST_CASE("on the sphere the copies fill 4π once on every sheet", "[bend]") {
  auto room = regular_room(3, 2);
  const auto copies = copies_of(room, 3);
  double whole = 0;
  for (const auto& corner : room.polygon.corners) whole += corner.angle;
  CHECK(copies.size() * (whole - std::numbers::pi) == Approx(4 * std::numbers::pi));
  const auto cover = floors(room, with_sheets(copies, 3, 2), eye_at(room.polygon.space, 0.2, 1.0, 0.4, 0.3, 0.1));
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int sheet = 0; sheet < 3; ++sheet) {
    int once = 0;
    for (int i = 0; i < 300; ++i) {
      // Sheet by sheet, down to the ring at the torn circles: the polygon that stands for the circle lies within 0.001 of it.
      const double r = sheet * std::numbers::pi + (std::numbers::pi - 0.003) * std::sqrt(unit(random)) + (sheet > 0 ? 0.001 : 0.0);
      const double phi = 2 * std::numbers::pi * unit(random);
      once += covers(cover, r * std::cos(phi), r * std::sin(phi)) == 1;
    }
    CAPTURE(sheet);
    CHECK(once == 300);
  }
}
