#include "compiler/image/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "compiler/base/elementary.h"

namespace orbc::image {
namespace {

/// round(255·encode_srgb(linear)) without its power. The codes grow with `linear`, so it is enough to know the smallest value of each code;
/// bisection finds them once, to the last bit. A table of cells leads to within a few codes of the right one.
class EncoderTo8Bits {
 public:
  EncoderTo8Bits() {
    smallest_[0] = 0;
    for (int code = 1; code < 256; ++code) {
      double below = smallest_[static_cast<std::size_t>(code - 1)], above = 1;
      for (double middle = (below + above) / 2; middle > below && middle < above; middle = (below + above) / 2)
        (std::lround(255 * encode_srgb(middle)) >= code ? above : below) = middle;
      smallest_[static_cast<std::size_t>(code)] = above;
    }
    std::size_t code = 0;
    for (std::size_t i = 0; i <= kCells; ++i) {
      while (code < 255 && smallest_[code + 1] <= static_cast<double>(i) / kCells) ++code;
      code_of_cell_[i] = static_cast<std::uint8_t>(code);
    }
  }
  [[nodiscard]] std::uint8_t operator()(double linear) const {
    const double x = linear > 0 ? std::min(linear, 1.0) : 0.0;  // NaN becomes black
    std::size_t code = code_of_cell_[static_cast<std::size_t>(x * kCells)];
    while (code < 255 && smallest_[code + 1] <= x) ++code;
    return static_cast<std::uint8_t>(code);
  }

 private:
  static constexpr std::size_t kCells = 4096;
  std::array<double, 256> smallest_;                   ///< linear value of each code
  std::array<std::uint8_t, kCells + 1> code_of_cell_;  ///< code of i/kCells
};

}  // namespace

double decode_srgb(double encoded) { return encoded <= 0.04045 ? encoded / 12.92 : math::pow((encoded + 0.055) / 1.055, 2.4); }

double encode_srgb(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * math::pow(x, 1 / 2.4) - 0.055;
}

std::uint8_t encode_srgb8(double linear) {
  static const EncoderTo8Bits encoder;
  return encoder(linear);
}

std::uint16_t encode_srgb16(double linear) { return static_cast<std::uint16_t>(std::lround(65535 * encode_srgb(linear))); }

double decode_srgb8(std::uint8_t code) {
  static const std::array<double, 256> table = [] {
    std::array<double, 256> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = decode_srgb(static_cast<double>(i) / 255);
    return linear;
  }();
  return table[code];
}

double decode_srgb16(std::uint16_t code) { return decode_srgb(code / 65535.0); }

}  // namespace orbc::image
