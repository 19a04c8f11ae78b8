#pragma once
#include <array>
#include <cmath>
#include <cstdint>

/// Sample sequences and random numbers. All are functions of their arguments alone.
namespace orbc::surface {

/// Hash of a 64-bit number: the finaliser of SplitMix64.
/// Source: Steele, Lea, Flood, Fast splittable pseudorandom number generators (2014).
[[nodiscard]] constexpr std::uint64_t splitmix64(std::uint64_t v) {
  v += 0x9e3779b97f4a7c15u;
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9u;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebu;
  return v ^ (v >> 31);
}

/// The fractional part v − ⌊v⌋.
[[nodiscard]] inline double fract(double v) { return v - std::floor(v); }

/// Point k of the R₃ sequence in the unit cube, shifted by `shift` (each coordinate in [0, 1)). Every first part of it is well spread.
/// Formula: shift + (k + 1)·(g⁻¹, g⁻², g⁻³) mod 1, where g⁴ = g + 1.
/// Source:  Roberts, The unreasonable effectiveness of quasirandom sequences (2018).
[[nodiscard]] constexpr std::array<double, 3> r3_point(int k, const std::array<double, 3>& shift = {0.5, 0.5, 0.5}) {
  constexpr double kG = 1.22074408460575947536;
  std::array<double, 3> at{shift[0] + (k + 1) / kG, shift[1] + (k + 1) / (kG * kG), shift[2] + (k + 1) / (kG * kG * kG)};
  for (double& v : at) v -= static_cast<double>(static_cast<long>(v));
  return at;
}

/// Point k of the R₆ sequence in the unit cube of six dimensions: the same with g⁷ = g + 1.
[[nodiscard]] constexpr std::array<double, 6> r6_point(int k, const std::array<double, 6>& shift) {
  constexpr double kG = 1.11277568427870622;
  std::array<double, 6> at = shift;
  double step = 1;
  for (double& v : at) {
    step /= kG;
    v += (k + 1) * step;
    v -= static_cast<double>(static_cast<long>(v));
  }
  return at;
}

/// Counter-based random numbers: the n-th number is a function of the key and n, so no picture depends on threads or their order.
class Random {
 public:
  explicit constexpr Random(std::uint64_t key) : key_(splitmix64(key)) {}
  constexpr Random(std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample)
      : key_(splitmix64(splitmix64(splitmix64(seed) ^ pixel) + sample)) {}
  /// Uniform in [0, 1).
  constexpr double next() { return static_cast<double>(splitmix64(key_ + count_++) >> 11) * 0x1p-53; }
  constexpr std::array<double, 3> next_three() {
    const double a = next(), b = next(), c = next();
    return {a, b, c};
  }

 private:
  std::uint64_t key_ = 0, count_ = 0;
};

}  // namespace orbc::surface
