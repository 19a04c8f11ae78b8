#pragma once
#include <array>
#include <optional>
#include <string>

#include "compiler/driver/product.h"

namespace orbc::svg {

inline constexpr const char* kPaper = "#fdfbf6";   ///< page, seams between copies, halos of labels
inline constexpr const char* kInk = "#22303f";     ///< frame and text
inline constexpr const char* kBase = "#e8684a";    ///< the room itself

/// Two colours of an author's own, "#rrggbb".
using Colors = std::optional<std::array<std::string, 2>>;

/// The fill of a copy, "#rrggbb". parity: mirror images dark, the others light, both fading into haze with the bounces. length: a ramp from
/// warm to cold over 0 … `longest` and beyond, mirror images a shade darker. Own colours stand for even copies and mirror images, or for
/// both ends of the ramp; they do not fade, and the room is not set apart.
[[nodiscard]] std::string fill_of(const cover::Copy& copy, int longest, driver::Tiling::Coloring coloring, const Colors& colors = {});
/// What the eye sees where copies are too small to be drawn.
[[nodiscard]] std::string haze(driver::Tiling::Coloring coloring, const Colors& colors = {});

/// Ink or paper, whichever stands out against a fill.
[[nodiscard]] std::string ink_on(const std::string& fill);

}  // namespace orbc::svg
