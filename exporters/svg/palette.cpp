// Colours are mixed in Oklab (Björn Ottosson, 2020, "A perceptual color space for image processing"), so that steps look even.
#include "exporters/svg/palette.h"

#include <algorithm>
#include <cmath>

#include "compiler/base/elementary.h"
#include "compiler/image/srgb.h"

namespace orbc::svg {
namespace {

struct Lab {
  double l = 0, a = 0, b = 0;
};

Lab lab_of(unsigned rgb) {
  const auto channel = [&](int shift) { return image::decode_srgb8(static_cast<std::uint8_t>(rgb >> shift & 255)); };
  const double r = channel(16), g = channel(8), b = channel(0);
  const double l = math::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = math::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = math::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s, 1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

std::string hex_of(const Lab& c) {
  const auto cube = [](double v) { return v * v * v; };
  const double l = cube(c.l + 0.3963377774 * c.a + 0.2158037573 * c.b), m = cube(c.l - 0.1055613458 * c.a - 0.0638541728 * c.b);
  const double s = cube(c.l - 0.0894841775 * c.a - 1.2914855480 * c.b);
  const double rgb[3] = {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s, -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                         -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string hex = "#";
  for (const double v : rgb) {
    const int code = image::encode_srgb8(v);
    hex += kDigits[code >> 4];
    hex += kDigits[code & 15];
  }
  return hex;
}

unsigned code_of(const std::string& color) { return static_cast<unsigned>(std::stoul(color.substr(1), nullptr, 16)); }

Lab mix(const Lab& a, const Lab& b, double t) { return {a.l + t * (b.l - a.l), a.a + t * (b.a - a.a), a.b + t * (b.b - a.b)}; }

constexpr unsigned kLight = 0xf3e7cf, kDark = 0x33586f, kHaze = 0x9aaab0;
constexpr std::array<unsigned, 6> kRamp{0xe8684a, 0xf2a65a, 0xf4d58d, 0x8fbfa3, 0x3f8396, 0x2c3f6b};

}  // namespace

std::string fill_of(const cover::Copy& copy, int longest, driver::Tiling::Coloring coloring, const Colors& colors) {
  const int length = static_cast<int>(copy.word.size());
  if (colors && coloring == driver::Tiling::Coloring::parity) return (*colors)[copy.cover_from_room.reversing ? 1 : 0];
  if (colors)
    return hex_of(mix(lab_of(code_of((*colors)[0])), lab_of(code_of((*colors)[1])), std::min(1.0, static_cast<double>(length) / longest)));
  if (coloring == driver::Tiling::Coloring::parity) {
    if (length == 0) return kBase;
    // The first reflections stand out; beyond some ten bounces parity is all that is left.
    const double fade = 0.55 * (1 - math::exp(-(length - 1) / 6.0));
    return hex_of(mix(lab_of(copy.cover_from_room.reversing ? kDark : kLight), lab_of(kHaze), fade));
  }
  const double at = longest > 0 ? static_cast<double>(length) / longest * (kRamp.size() - 1) : 0;
  const std::size_t step = std::min(static_cast<std::size_t>(at), kRamp.size() - 2);
  Lab color = mix(lab_of(kRamp[step]), lab_of(kRamp[step + 1]), at - static_cast<double>(step));
  if (copy.cover_from_room.reversing) color.l -= 0.045;
  return hex_of(color);
}

std::string haze(driver::Tiling::Coloring coloring, const Colors& colors) {
  if (colors)
    return hex_of(
        mix(lab_of(code_of((*colors)[0])), lab_of(code_of((*colors)[1])), coloring == driver::Tiling::Coloring::parity ? 0.5 : 1));
  return hex_of(coloring == driver::Tiling::Coloring::parity ? lab_of(kHaze) : lab_of(kRamp.back()));
}

std::string ink_on(const std::string& fill) { return lab_of(code_of(fill)).l > 0.62 ? kInk : kPaper; }

}  // namespace orbc::svg
