#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "compiler/cover/copy.h"
#include "compiler/notation/parse.h"

namespace orbc::test {

inline notation::Orbifold orbifold(const std::string& text) { return notation::parse(text).value(); }

/// The reflection group of a room as matrices over a finite field: s(α_t) = α_t + 2cos(π/m)·α_s with 2cos(π/m) = ζ + 1/ζ, ζ of order 2m.
/// Knows nothing of roots or automata; different matrices are certainly different elements.
class FieldGroup {
 public:
  using Matrix = std::vector<std::uint64_t>;  // columns: images of the simple roots

  explicit FieldGroup(const notation::Orbifold& o) {
    walls_ = notation::is_half_strip(o) ? 3 : o.strip ? 2 : std::max<std::size_t>(o.corners.size(), 1);
    std::uint64_t order = 2;
    for (const Rational& k : o.corners) order = lcm(order, 2 * static_cast<std::uint64_t>(numerator(k)));
    prime_ = 2'000'000'000 / order * order + 1;
    while (!is_prime(prime_)) prime_ += order;
    bonds_.assign(walls_ * walls_, 2);  // ∞: 2cos 0
    for (std::size_t i = 0; i < walls_; ++i) bonds_[i * walls_ + i] = prime_ - 2;
    for (std::size_t i = 0; i < o.corners.size(); ++i) {
      const std::size_t other = (i + walls_ - 1) % walls_;
      bonds_[i * walls_ + other] = bonds_[other * walls_ + i] = twice_cosine(2 * static_cast<std::uint64_t>(numerator(o.corners[i])));
    }
  }

  [[nodiscard]] std::size_t walls() const { return walls_; }

  [[nodiscard]] Matrix one() const {
    Matrix m(walls_ * walls_, 0);
    for (std::size_t i = 0; i < walls_; ++i) m[i * walls_ + i] = 1;
    return m;
  }

  /// m · s_wall: the image of α_t becomes m(α_t) + bond·m(α_wall).
  [[nodiscard]] Matrix multiply(const Matrix& m, std::size_t wall) const {
    Matrix product = m;
    for (std::size_t t = 0; t < walls_; ++t)
      for (std::size_t row = 0; row < walls_; ++row)
        product[t * walls_ + row] = (m[t * walls_ + row] + bonds_[wall * walls_ + t] * m[wall * walls_ + row]) % prime_;
    return product;
  }

  [[nodiscard]] Matrix element(const cover::Word& word) const {
    Matrix m = one();
    for (const std::uint8_t wall : word) m = multiply(m, wall);
    return m;
  }

 private:
  static std::uint64_t gcd(std::uint64_t a, std::uint64_t b) { return b == 0 ? a : gcd(b, a % b); }
  static std::uint64_t lcm(std::uint64_t a, std::uint64_t b) { return a / gcd(a, b) * b; }
  static bool is_prime(std::uint64_t n) {
    for (std::uint64_t d = 2; d * d <= n; ++d)
      if (n % d == 0) return false;
    return true;
  }
  [[nodiscard]] std::uint64_t power(std::uint64_t base, std::uint64_t exponent) const {
    std::uint64_t result = 1;
    for (; exponent > 0; exponent /= 2, base = base * base % prime_)
      if (exponent % 2 == 1) result = result * base % prime_;
    return result;
  }
  [[nodiscard]] std::uint64_t twice_cosine(std::uint64_t order) const {
    for (std::uint64_t x = 2;; ++x) {
      const std::uint64_t zeta = power(x, (prime_ - 1) / order);
      bool primitive = true;
      for (std::uint64_t d = 1; d < order; ++d) primitive = primitive && (order % d != 0 || power(zeta, d) != 1);
      if (primitive) return (zeta + power(zeta, prime_ - 2)) % prime_;
    }
  }

  std::size_t walls_ = 0;
  std::uint64_t prime_ = 0;
  std::vector<std::uint64_t> bonds_;
};

/// All elements up to a length by plain search: the first word that reaches a matrix, in ShortLex order, is its normal form.
struct Ball {
  std::map<FieldGroup::Matrix, cover::Word> normal_forms;
  std::vector<std::vector<cover::Word>> by_length;
};

inline Ball ball(const FieldGroup& group, int length, std::size_t most = 20000) {
  Ball b;
  b.normal_forms[group.one()] = {};
  b.by_length.push_back({{}});
  for (int l = 0; l < length && b.normal_forms.size() < most; ++l) {
    std::vector<cover::Word> next;
    for (const cover::Word& word : b.by_length.back()) {
      const FieldGroup::Matrix m = group.element(word);
      for (std::size_t wall = 0; wall < group.walls(); ++wall) {
        cover::Word longer = word;
        longer.push_back(static_cast<std::uint8_t>(wall));
        if (b.normal_forms.insert({group.multiply(m, wall), longer}).second) next.push_back(longer);
      }
    }
    b.by_length.push_back(next);
  }
  return b;
}

}  // namespace orbc::test
