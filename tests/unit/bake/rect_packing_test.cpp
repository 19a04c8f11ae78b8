#include "compiler/bake/rect_packing.h"

#include <catch2/catch.hpp>
#include <random>

using namespace orbc;
using bake::PackedRects;
using bake::TexelRect;

namespace {

std::vector<TexelRect> some_rects(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::vector<TexelRect> rects;
  for (int i = 0; i < count; ++i) rects.push_back({2 + static_cast<int>(random() % 40), 2 + static_cast<int>(random() % 25)});
  return rects;
}

void check_places(const std::vector<TexelRect>& wanted, const PackedRects& packed, int top) {
  REQUIRE(packed.rects.size() == wanted.size());
  std::vector<int> texels(static_cast<std::size_t>(packed.width) * static_cast<std::size_t>(packed.height), 0);
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const TexelRect& rect = packed.rects[k];
    REQUIRE(rect.width == wanted[k].width);
    REQUIRE(rect.height == wanted[k].height);
    REQUIRE(rect.x >= 0);
    REQUIRE(rect.y >= top);
    REQUIRE(rect.x + rect.width <= packed.width);
    REQUIRE(rect.y + rect.height <= packed.height);
    for (int y = rect.y; y < rect.y + rect.height; ++y)
      for (int x = rect.x; x < rect.x + rect.width; ++x)
        REQUIRE(++texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(packed.width) + static_cast<std::size_t>(x)] == 1);
  }
}

}  // namespace

TEST_CASE("rectangles do not overlap, and the picture is as small a power of two as holds them", "[bake]") {
  for (const int count : {1, 7, 300}) {
    const std::vector<TexelRect> rects = some_rects(static_cast<unsigned>(count), count);
    const auto packed = bake::pack_rects(rects, 4096);
    REQUIRE(packed);
    check_places(rects, *packed, 0);
    CHECK(packed->height <= packed->width);
    CHECK((packed->width & (packed->width - 1)) == 0);
    CHECK_FALSE(bake::pack_rects(rects, packed->width / 4));
  }
}

TEST_CASE("rectangles that come later lie below the rows that are taken", "[bake]") {
  const std::vector<TexelRect> rects = some_rects(5, 100);
  const auto packed = bake::pack_below(rects, 64, 77, 4096);
  REQUIRE(packed);
  check_places(rects, *packed, 77);
  CHECK(packed->width >= 64);
  CHECK_FALSE(bake::pack_below(rects, 64, 77, 128));
  CHECK_FALSE(bake::pack_below({{200, 3}}, 64, 77, 128));
}
