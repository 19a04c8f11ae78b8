#include "compiler/image/srgb.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace orbc::image;

TEST_CASE("sRGB decoding and encoding are inverse, and linear near black", "[image]") {
  for (int i = 0; i <= 255; ++i) CHECK(encode_srgb(decode_srgb(i / 255.0)) == Approx(i / 255.0).margin(1e-9));
  CHECK(decode_srgb(0.5) == Approx(0.21404114048223255).epsilon(1e-12));
  CHECK(decode_srgb(0.04) == Approx(0.04 / 12.92));
  CHECK(encode_srgb(-1) == 0);
  CHECK(encode_srgb(7) == Approx(1));
}

TEST_CASE("codes are the rounded encoded values, and come back from linear light", "[image]") {
  for (int i = 0; i <= 255; ++i) REQUIRE(encode_srgb8(decode_srgb8(static_cast<std::uint8_t>(i))) == i);
  for (int i = 0; i <= 65535; ++i) REQUIRE(encode_srgb16(decode_srgb16(static_cast<std::uint16_t>(i))) == i);
  for (int i = 0; i < 255; ++i) {
    const double step = decode_srgb((i + 0.5) / 255);  // where the code changes
    for (const double v : {step, std::nextafter(step, 0.0), std::nextafter(step, 1.0), i / 255.0})
      REQUIRE(encode_srgb8(v) == std::lround(255 * encode_srgb(v)));
  }
  for (const double dark : {-3.0, -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    CHECK(encode_srgb8(dark) == 0);
  CHECK(encode_srgb8(std::numeric_limits<double>::infinity()) == 255);
}
