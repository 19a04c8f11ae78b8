#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace orbc::diff {

/// What two files may differ by.
struct Limits {
  double within = 0;  ///< of a number, as measured by `distance`
  int pixels = 0;     ///< of a channel of a picture, in steps of 1/255
};

/// Where the two files first differ by more than the limits allow.
struct Difference {
  std::string at, at_in_other;  ///< line:column, JSON path, or which element of which accessor
  std::string what;             ///< "0.25 against 0.26"
};

/// What comparing has found. Numbers and pixels are counted up to a difference in structure, behind which nothing is comparable.
struct Finding {
  std::uint64_t numbers = 0;  ///< compared
  std::uint64_t numbers_differing = 0, numbers_beyond = 0;
  double largest = 0;  ///< difference of numbers, by `distance`
  std::string largest_at;
  std::uint64_t pictures = 0, pixels = 0;  ///< compared
  std::uint64_t pixels_differing = 0, pixels_beyond = 0;
  double largest_step = 0;  ///< of pictures, in steps of 1/255
  std::string largest_step_at;
  bool same_structure = true;
  bool differs = false;
  Difference first;  ///< if they differ

  /// Takes down a difference that the limits do not allow; only the first is kept.
  void differ(Difference difference) {
    if (!differs) first = std::move(difference);
    differs = true;
  }
  void differ_in_structure(Difference difference) {
    differ(std::move(difference));
    same_structure = false;
  }
};

/// |a − b| / max(1, |a|, |b|): absolute for numbers up to 1, relative beyond. Two NaN, and infinities of one sign, are at distance 0;
/// whatever else is not finite is infinitely far away.
[[nodiscard]] inline double distance(double a, double b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  if (!std::isfinite(a) || !std::isfinite(b)) return std::numeric_limits<double>::infinity();
  const double size = std::max({1.0, std::fabs(a), std::fabs(b)});
  return std::fabs(a / size - b / size);
}

}  // namespace orbc::diff
