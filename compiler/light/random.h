#pragma once
#include <array>
#include <cstdint>

namespace orbc::light {

/// A well mixed number of a number: the finaliser of SplitMix64 (Steele, Lea, Flood, Fast splittable pseudorandom number generators, 2014).
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t v) {
  v += 0x9e3779b97f4a7c15u;
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9u;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebu;
  return v ^ (v >> 31);
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

}  // namespace orbc::light
