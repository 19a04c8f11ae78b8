#pragma once
#include <array>
#include <cmath>
#include <cstdint>

namespace orbc::surface {

/// A well mixed number of a number: the finaliser of SplitMix64 (Steele, Lea, Flood, Fast splittable pseudorandom number generators, 2014).
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t v) {
  v += 0x9e3779b97f4a7c15u;
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9u;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebu;
  return v ^ (v >> 31);
}

/// What stands behind the point.
[[nodiscard]] inline double fraction(double v) { return v - std::floor(v); }

/// The k-th point of the unit cube, moved by `shift` (each part in [0, 1)): the lattice of the number that solves x⁴ = x + 1, whose every
/// beginning is well spread (Roberts, The unreasonable effectiveness of quasirandom sequences, 2018).
[[nodiscard]] constexpr std::array<double, 3> r3_point(int k, const std::array<double, 3>& shift = {0.5, 0.5, 0.5}) {
  constexpr double kG = 1.22074408460575947536;
  std::array<double, 3> at{shift[0] + (k + 1) / kG, shift[1] + (k + 1) / (kG * kG), shift[2] + (k + 1) / (kG * kG * kG)};
  for (double& v : at) v -= static_cast<double>(static_cast<long>(v));
  return at;
}

/// The same of the unit cube of six dimensions: of the number that solves x⁷ = x + 1.
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

/// Random numbers by counting: the n-th number of a key is a function of both alone, so that no picture depends on threads or order.
class Random {
 public:
  explicit constexpr Random(std::uint64_t key) : key_(mixed(key)) {}
  constexpr Random(std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample) : key_(mixed(mixed(mixed(seed) ^ pixel) + sample)) {}
  /// Even in [0, 1).
  constexpr double next() { return static_cast<double>(mixed(key_ + count_++) >> 11) * 0x1p-53; }
  constexpr std::array<double, 3> next_three() {
    const double a = next(), b = next(), c = next();
    return {a, b, c};
  }

 private:
  std::uint64_t key_ = 0, count_ = 0;
};

}  // namespace orbc::surface
