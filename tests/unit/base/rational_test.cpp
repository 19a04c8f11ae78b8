#include "compiler/base/rational.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace orbc {
namespace {

using Number = boost::multiprecision::cpp_int;
using Fraction = boost::multiprecision::cpp_rational;

/// Small numbers and long ones, of both signs.
std::vector<std::string> numbers() {
  std::mt19937_64 random(7);
  std::vector<std::string> list = {"0", "1", "-1", "2", "-7", "18446744073709551615", "18446744073709551616", "-9223372036854775809"};
  for (int digits = 1; digits < 90; digits += 8) {
    std::string text = digits % 3 == 0 ? "-" : "";
    for (int i = 0; i < digits; ++i) text += static_cast<char>('1' + random() % 9);
    list.push_back(text);
  }
  return list;
}

TEST_CASE("integers of any size add, multiply, divide and compare as Boost's do", "[base]") {
  for (const std::string& x : numbers())
    for (const std::string& y : numbers()) {
      const Integer a(x), b(y);
      const Number p(x), q(y);
      CHECK(to_string(a + b) == Number(p + q).str());
      CHECK(to_string(a - b) == Number(p - q).str());
      CHECK(to_string(a * b) == Number(p * q).str());
      if (q != 0) CHECK(to_string(a / b) == Number(p / q).str());
      CHECK((a < b) == (p < q));
      CHECK((a == b) == (p == q));
      CHECK(static_cast<double>(a) == p.convert_to<double>());
    }
}

TEST_CASE("fractions are in lowest terms and calculate as Boost's do", "[base]") {
  const std::vector<std::string> list = numbers();
  for (std::size_t i = 0; i + 3 < list.size(); ++i) {
    if (list[i + 1] == "0" || list[i + 3] == "0") continue;
    const Rational a{Integer(list[i]), Integer(list[i + 1])}, b{Integer(list[i + 2]), Integer(list[i + 3])};
    const Fraction p = Fraction(Number(list[i])) / Number(list[i + 1]), q = Fraction(Number(list[i + 2])) / Number(list[i + 3]);
    CHECK(to_string(a) == p.str());
    CHECK(to_string(a + b) == Fraction(p + q).str());
    CHECK(to_string(a - b) == Fraction(p - q).str());
    CHECK(to_string(a * b) == Fraction(p * q).str());
    if (q != 0) CHECK(to_string(a / b) == Fraction(p / q).str());
    CHECK((a < b) == (p < q));
    CHECK(static_cast<double>(a) == p.convert_to<double>());
    CHECK(denominator(a) > 0);
  }
}

TEST_CASE("an integer outside a type's range becomes the nearest value of that type", "[base]") {
  const Integer large("99999999999999999999999"), small = -large;
  CHECK(static_cast<int>(large) == std::numeric_limits<int>::max());
  CHECK(static_cast<int>(small) == std::numeric_limits<int>::min());
  CHECK(static_cast<std::int64_t>(small) == std::numeric_limits<std::int64_t>::min());
  CHECK(static_cast<std::uint64_t>(large) == std::numeric_limits<std::uint64_t>::max());
  CHECK(static_cast<std::uint64_t>(small) == 0);
  CHECK(static_cast<std::uint8_t>(Integer(256)) == 255);
  CHECK(static_cast<std::int8_t>(Integer(-129)) == -128);
  CHECK(static_cast<int>(Integer(-42)) == -42);
}

TEST_CASE("digits after leading zeros are decimal", "[base]") {
  CHECK(Integer("010") == 10);
  CHECK(Integer("-0017") == -17);
  CHECK(Integer("000") == 0);
}

TEST_CASE("what an integer is moved into holds its number", "[base]") {
  Integer from("123456789012345678901234567890"), copied = from, into = std::move(from);
  CHECK(into == copied);
  from = 5;
  into = std::move(from);
  CHECK(into == 5);
  copied = into;
  CHECK(copied == 5);
  CHECK(pow(Integer(-3), 5) == -243);
  CHECK(abs(Integer("-12345678901234567890123")) == Integer("12345678901234567890123"));
}

}  // namespace
}  // namespace orbc
