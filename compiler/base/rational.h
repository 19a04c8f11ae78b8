#pragma once
#include <boost/multiprecision/cpp_int.hpp>
#include <string>

namespace orbc {

/// Exact integers and rationals of any size; decisions about orbifolds are made with these, never with floats.
using Integer = boost::multiprecision::cpp_int;
using Rational = boost::multiprecision::cpp_rational;

[[nodiscard]] inline bool is_integer(const Rational& value) { return denominator(value) == 1; }

/// "-1/84", "2", "0".
[[nodiscard]] inline std::string to_string(const Rational& value) { return value.str(); }
[[nodiscard]] inline std::string to_string(const Integer& value) { return value.str(); }

}  // namespace orbc
