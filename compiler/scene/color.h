#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orbc::scene {

/// A colour in linear light (Rec. 709 primaries). Colours in scene files ("coral", "#ff7f50", [1, 0.5, 0.3]) are sRGB-encoded.
struct Color {
  double r = 0, g = 0, b = 0;
};
[[nodiscard]] constexpr Color operator*(const Color& a, const Color& b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
[[nodiscard]] constexpr Color operator*(double s, const Color& c) { return {s * c.r, s * c.g, s * c.b}; }
[[nodiscard]] constexpr Color operator+(const Color& a, const Color& b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
[[nodiscard]] constexpr bool operator==(const Color& a, const Color& b) { return a.r == b.r && a.g == b.g && a.b == b.b; }
/// The minimum of each channel.
[[nodiscard]] constexpr Color component_min(const Color& a, const Color& b) {
  return {std::min(a.r, b.r), std::min(a.g, b.g), std::min(a.b, b.b)};
}
/// The largest channel.
[[nodiscard]] constexpr double max_channel(const Color& c) { return std::max({c.r, c.g, c.b}); }

/// The colour of three sRGB-encoded channels in 0…1.
[[nodiscard]] Color from_srgb(double r, double g, double b);
/// The colour of 0xRRGGBB, sRGB-encoded.
[[nodiscard]] Color from_hex(unsigned rrggbb);

/// The 148 names of CSS Color Module Level 4 ("coral", "rebeccapurple"; lower case), in alphabetical order.
[[nodiscard]] const std::vector<std::string>& color_names();
[[nodiscard]] std::optional<Color> named_color(std::string_view name);
/// The colour of a CSS name, "#rgb" or "#rrggbb".
[[nodiscard]] std::optional<Color> parse_color(std::string_view text);

/// The colour of a black body, scaled so that its largest channel is 1.
/// In:     kelvin in 1667…25000.
/// Source: Kim et al., "Design of advanced color temperature control system for HDTV applications" (2002): cubic fits of the Planckian
/// locus.
[[nodiscard]] Color color_of_temperature(double kelvin);

}  // namespace orbc::scene
