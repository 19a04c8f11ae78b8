#pragma once
#include <numbers>

namespace orbc {

/// An angle; the unit is chosen where it is made or read, never guessed.
struct Angle {
  double radians = 0;
  [[nodiscard]] static constexpr Angle from_degrees(double degrees) { return {degrees * std::numbers::pi / 180}; }
  [[nodiscard]] constexpr double degrees() const { return radians * 180 / std::numbers::pi; }
};

}  // namespace orbc
