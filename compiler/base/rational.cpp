#include "compiler/base/rational.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <new>
#include <ostream>
#include <utility>

namespace orbc {

namespace {
using Number = boost::multiprecision::cpp_int;
}

/// Reaches the number inside an Integer.
struct BoostNumbers {
  static_assert(sizeof(Number) <= sizeof(Integer::number_) && alignof(Number) <= 16);

  template <class... T>
  static void construct(Integer& integer, T&&... from) {
    ::new (static_cast<void*>(integer.number_)) Number(std::forward<T>(from)...);
  }
  static Number& in(Integer& integer) { return *std::launder(reinterpret_cast<Number*>(integer.number_)); }
  static const Number& in(const Integer& integer) { return *std::launder(reinterpret_cast<const Number*>(integer.number_)); }
  static Integer wrapped(Number number) {
    Integer integer;
    in(integer) = std::move(number);
    return integer;
  }
};

namespace {

const Number& number(const Integer& integer) { return BoostNumbers::in(integer); }

}  // namespace

Integer::Integer() noexcept { BoostNumbers::construct(*this); }
Integer::Integer(From, std::int64_t value) noexcept { BoostNumbers::construct(*this, value); }
Integer::Integer(From, std::uint64_t value) noexcept { BoostNumbers::construct(*this, value); }
Integer::Integer(std::string_view decimal) {
  // Boost takes a leading 0 for the sign of octal digits.
  const bool negative = !decimal.empty() && decimal.front() == '-';
  if (negative) decimal.remove_prefix(1);
  decimal.remove_prefix(std::min(decimal.find_first_not_of('0'), decimal.size()));
  BoostNumbers::construct(*this, decimal.empty() ? "0" : std::string(decimal));
  if (negative) *this = -*this;
}
Integer::Integer(const Integer& other) { BoostNumbers::construct(*this, number(other)); }
Integer::Integer(Integer&& other) noexcept { BoostNumbers::construct(*this, std::move(BoostNumbers::in(other))); }
Integer& Integer::operator=(const Integer& other) {
  BoostNumbers::in(*this) = number(other);
  return *this;
}
Integer& Integer::operator=(Integer&& other) noexcept {
  BoostNumbers::in(*this) = std::move(BoostNumbers::in(other));
  return *this;
}
Integer::~Integer() { BoostNumbers::in(*this).~Number(); }

Integer& Integer::operator+=(const Integer& other) {
  BoostNumbers::in(*this) += number(other);
  return *this;
}
Integer& Integer::operator-=(const Integer& other) {
  BoostNumbers::in(*this) -= number(other);
  return *this;
}
Integer& Integer::operator*=(const Integer& other) {
  BoostNumbers::in(*this) *= number(other);
  return *this;
}
Integer& Integer::operator/=(const Integer& other) {
  BoostNumbers::in(*this) /= number(other);
  return *this;
}
Integer Integer::operator-() const { return BoostNumbers::wrapped(-number(*this)); }

int Integer::compare(const Integer& other) const {
  const int order = number(*this).compare(number(other));
  return order < 0 ? -1 : order > 0 ? 1 : 0;
}
std::int64_t Integer::clamped(std::int64_t least, std::int64_t most) const {
  const Number& value = number(*this);
  return value < least ? least : value > most ? most : value.convert_to<std::int64_t>();
}
std::uint64_t Integer::clamped(std::uint64_t most) const {
  const Number& value = number(*this);
  return value < 0 ? 0 : value > most ? most : value.convert_to<std::uint64_t>();
}
Integer::operator double() const { return number(*this).convert_to<double>(); }

Rational::Rational(Integer numerator, Integer denominator) : numerator_(std::move(numerator)), denominator_(std::move(denominator)) {
  Number divisor = gcd(number(numerator_), number(denominator_));
  if (denominator_ < 0) divisor = -divisor;
  if (divisor == 1) return;
  BoostNumbers::in(numerator_) /= divisor;
  BoostNumbers::in(denominator_) /= divisor;
}

Rational& Rational::operator+=(const Rational& other) {
  return *this = Rational(numerator_ * other.denominator_ + other.numerator_ * denominator_, denominator_ * other.denominator_);
}
Rational& Rational::operator-=(const Rational& other) { return *this += -other; }
Rational& Rational::operator*=(const Rational& other) {
  return *this = Rational(numerator_ * other.numerator_, denominator_ * other.denominator_);
}
Rational& Rational::operator/=(const Rational& other) {
  return *this = Rational(numerator_ * other.denominator_, denominator_ * other.numerator_);
}
Rational Rational::operator-() const {
  Rational negated = *this;
  negated.numerator_ = -negated.numerator_;
  return negated;
}
std::strong_ordering operator<=>(const Rational& a, const Rational& b) {
  return a.numerator_ * b.denominator_ <=> b.numerator_ * a.denominator_;
}
Rational::operator double() const {
  return boost::multiprecision::cpp_rational(number(numerator_), number(denominator_)).convert_to<double>();
}

Integer abs(const Integer& value) { return value < 0 ? -value : value; }
Integer pow(const Integer& base, unsigned exponent) { return BoostNumbers::wrapped(boost::multiprecision::pow(number(base), exponent)); }

std::string to_string(const Integer& value) { return number(value).str(); }
std::string to_string(const Rational& value) {
  return is_integer(value) ? to_string(numerator(value)) : to_string(numerator(value)) + '/' + to_string(denominator(value));
}
std::ostream& operator<<(std::ostream& out, const Integer& value) { return out << to_string(value); }
std::ostream& operator<<(std::ostream& out, const Rational& value) { return out << to_string(value); }

}  // namespace orbc
