#include "compiler/verify/compare.h"

#include <catch2/catch.hpp>

#include "compiler/image/image.h"

using namespace orbc;

namespace {

image::Image plain(int width, int height, std::uint8_t value) {
  return {width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4, value)};
}

void paint(image::Image& image, int x, int y, std::uint8_t value) {
  for (int c = 0; c < 3; ++c) image.rgba[static_cast<std::size_t>(4 * (y * image.width + x) + c)] = value;
}

}  // namespace

TEST_CASE("equal pictures agree everywhere", "[driver]") {
  const image::Image a = plain(7, 5, 100);
  const verify::Comparison c = verify::compare(a, a);
  CHECK(c.pixels == 35);
  CHECK(c.within_1 == 35);
  CHECK(c.mean == 0);
  CHECK(c.largest == 0);
}

TEST_CASE("a difference counts by its largest channel", "[driver]") {
  image::Image b = plain(4, 4, 100);
  b.rgba[1] = 103;
  const verify::Comparison c = verify::compare(plain(4, 4, 100), b);
  CHECK(c.within_2 == 15);
  CHECK(c.within_4 == 16);
  CHECK(c.largest == 3);
  CHECK(c.mean == Approx(3.0 / 16));
}

TEST_CASE("a difference beside an edge is told from one in the open", "[driver]") {
  image::Image a = plain(20, 3, 50);
  for (int y = 0; y < 3; ++y)
    for (int x = 10; x < 20; ++x) paint(a, x, y, 200);
  image::Image b = a;
  paint(b, 10, 1, 50);  // the edge has moved by a pixel
  verify::Comparison c = verify::compare(a, b);
  CHECK(c.beyond_on_edge == 1);
  CHECK(c.beyond_off_edge == 0);
  image::Image smooth = plain(20, 20, 50), ramp = smooth;  // a slow drift has no edge of its own
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) paint(ramp, x, y, static_cast<std::uint8_t>(50 + 2 * x));
  c = verify::compare(smooth, ramp);
  CHECK(c.beyond_on_edge == 0);
  CHECK(c.beyond_off_edge == 18 * 20);
  CHECK(verify::difference_picture(smooth, ramp).rgba[4 * 19] == 255);
}
