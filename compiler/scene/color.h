#pragma once

namespace orbc::scene {

/// A colour in linear light (Rec. 709 primaries). What an author writes ("coral", "#ff7f50", [1, 0.5, 0.3]) is sRGB-encoded.
struct Color {
  double r = 0, g = 0, b = 0;
};
[[nodiscard]] constexpr Color operator*(const Color& a, const Color& b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
[[nodiscard]] constexpr Color operator*(double s, const Color& c) { return {s * c.r, s * c.g, s * c.b}; }
[[nodiscard]] constexpr Color operator+(const Color& a, const Color& b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }

/// IEC 61966-2-1 transfer function, one channel, both ways; values outside [0, 1] are clamped by `encode_srgb` only.
[[nodiscard]] double decode_srgb(double encoded);
[[nodiscard]] double encode_srgb(double linear);

}  // namespace orbc::scene
