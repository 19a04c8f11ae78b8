#pragma once
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <utility>

namespace orbc {

/// An exact integer of any size. The number is one of Boost.Multiprecision, whose headers only rational.cpp reads: they take a compiler
/// more than two seconds, and every room holds a Rational.
class Integer {
 public:
  Integer() noexcept;
  template <std::signed_integral T>
  Integer(T value) noexcept : Integer(From{}, static_cast<std::int64_t>(value)) {}
  template <std::unsigned_integral T>
  Integer(T value) noexcept : Integer(From{}, static_cast<std::uint64_t>(value)) {}
  /// In: decimal digits, at least one, after a "-" or nothing.
  explicit Integer(std::string_view decimal);
  Integer(const Integer& other);
  Integer(Integer&& other) noexcept;
  Integer& operator=(const Integer& other);
  Integer& operator=(Integer&& other) noexcept;
  ~Integer();

  Integer& operator+=(const Integer& other);
  Integer& operator-=(const Integer& other);
  Integer& operator*=(const Integer& other);
  Integer& operator/=(const Integer& other);  ///< Rounds towards zero. In: other ≠ 0.
  Integer& operator++() { return *this += 1; }
  Integer operator-() const;
  friend Integer operator+(Integer a, const Integer& b) { return a += b; }
  friend Integer operator-(Integer a, const Integer& b) { return a -= b; }
  friend Integer operator*(Integer a, const Integer& b) { return a *= b; }
  friend Integer operator/(Integer a, const Integer& b) { return a /= b; }
  friend bool operator==(const Integer& a, const Integer& b) { return a.compare(b) == 0; }
  friend std::strong_ordering operator<=>(const Integer& a, const Integer& b) { return a.compare(b) <=> 0; }

  /// The nearest value of the type: the least or the largest one when the number lies outside its range.
  template <std::signed_integral T>
  explicit operator T() const {
    return static_cast<T>(
        clamped(std::int64_t{static_cast<T>(T{1} << (8 * sizeof(T) - 1))}, std::int64_t{static_cast<T>(~(T{1} << (8 * sizeof(T) - 1)))}));
  }
  template <std::unsigned_integral T>
  explicit operator T() const {
    return static_cast<T>(clamped(static_cast<std::uint64_t>(static_cast<T>(~T{0}))));
  }
  explicit operator double() const;

 private:
  friend struct BoostNumbers;
  struct From {};
  Integer(From, std::int64_t value) noexcept;
  Integer(From, std::uint64_t value) noexcept;
  [[nodiscard]] int compare(const Integer& other) const;  ///< -1, 0 or 1
  [[nodiscard]] std::int64_t clamped(std::int64_t least, std::int64_t most) const;
  [[nodiscard]] std::uint64_t clamped(std::uint64_t most) const;

  alignas(16) std::byte number_[32];  ///< holds the Boost number, which needs no more (checked in rational.cpp)
};

/// An exact fraction in lowest terms. Decisions about orbifolds are made with these, never with floating point.
class Rational {
 public:
  Rational() : Rational(0) {}
  template <std::integral T>
  Rational(T value) : numerator_(value), denominator_(1) {}
  Rational(Integer value) : numerator_(std::move(value)), denominator_(1) {}
  /// In: denominator ≠ 0.
  Rational(Integer numerator, Integer denominator);

  Rational& operator+=(const Rational& other);
  Rational& operator-=(const Rational& other);
  Rational& operator*=(const Rational& other);
  Rational& operator/=(const Rational& other);  ///< In: other ≠ 0.
  Rational operator-() const;
  friend Rational operator+(Rational a, const Rational& b) { return a += b; }
  friend Rational operator-(Rational a, const Rational& b) { return a -= b; }
  friend Rational operator*(Rational a, const Rational& b) { return a *= b; }
  friend Rational operator/(Rational a, const Rational& b) { return a /= b; }
  friend bool operator==(const Rational& a, const Rational& b) = default;
  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b);
  friend const Integer& numerator(const Rational& value) { return value.numerator_; }
  /// Positive.
  friend const Integer& denominator(const Rational& value) { return value.denominator_; }

  /// The nearest double.
  explicit operator double() const;

 private:
  Integer numerator_, denominator_;
};

[[nodiscard]] Integer abs(const Integer& value);
[[nodiscard]] Integer pow(const Integer& base, unsigned exponent);
[[nodiscard]] inline bool is_integer(const Rational& value) { return denominator(value) == 1; }

/// "-1/84", "2", "0".
[[nodiscard]] std::string to_string(const Rational& value);
[[nodiscard]] std::string to_string(const Integer& value);
std::ostream& operator<<(std::ostream& out, const Integer& value);
std::ostream& operator<<(std::ostream& out, const Rational& value);

}  // namespace orbc
