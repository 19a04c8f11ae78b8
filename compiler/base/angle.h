#pragma once
#include <numbers>

namespace orbc {

/// An angle. Its unit is named wherever it is made or read.
struct Angle {
  double radians = 0;
  [[nodiscard]] static constexpr Angle from_degrees(double degrees) { return {degrees * std::numbers::pi / 180}; }
  [[nodiscard]] constexpr double degrees() const { return radians * 180 / std::numbers::pi; }
};

}  // namespace orbc
