#pragma once
#include <array>
#include <string>

#include "compiler/driver/product.h"

namespace orbc::svg {

inline constexpr const char* kPaper = "#fdfbf6";   ///< page, seams between copies, halos of labels
inline constexpr const char* kInk = "#22303f";     ///< frame and text
inline constexpr const char* kBase = "#e8684a";    ///< the room itself

/// The fill of a copy, "#rrggbb". parity: mirror images dark, the others light, both fading into haze with the bounces. length: a ramp from
/// warm to cold over 0 … `longest` and beyond, mirror images a shade darker.
[[nodiscard]] std::string fill_of(const cover::Copy& copy, int longest, driver::Tiling::Colouring colouring);
/// What the eye sees where copies are too small to be drawn.
[[nodiscard]] std::string haze(driver::Tiling::Colouring colouring);

}  // namespace orbc::svg
