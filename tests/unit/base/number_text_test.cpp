#include "compiler/base/number_text.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace orbc;

namespace {
std::string shortest(double value) {
  char text[32];
  return {text, put_shortest(text, value)};
}
}  // namespace

TEST_CASE("a number at the beginning of a text ends where its letters do", "[base]") {
  CHECK(leading_number("1.5e-3,4").value == 1.5e-3);
  CHECK(leading_number("1.5e-3,4").length == 6);
  CHECK(leading_number("-.25").value == -0.25);
  CHECK(leading_number("2-3").length == 1);
  for (const char* none : {"", "-", "+1", " 1", "x", "e5"}) CHECK(leading_number(none).length == 0);
}

TEST_CASE("numbers too large or too small for a double are told", "[base]") {
  CHECK(leading_number("1e999").out_of_range);
  CHECK(leading_number("1e-999").out_of_range);
  CHECK_FALSE(leading_number("0e-999").out_of_range);
  CHECK_FALSE(leading_number("0.000").out_of_range);
}

TEST_CASE("the shortest text of a number has an exponent where that is shorter", "[base]") {
  CHECK(shortest(0.1) == "0.1");
  CHECK(shortest(-1234.5) == "-1234.5");
  CHECK(shortest(1e-7) == "1e-07");
  CHECK(shortest(1e5) == "1e+05");
  CHECK(shortest(123456) == "123456");
  CHECK(std::stod(shortest(M_PI)) == M_PI);
}
