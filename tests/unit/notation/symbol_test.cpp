#include "compiler/notation/symbol.h"

#include <catch2/catch.hpp>

using namespace orbc;
using notation::Symbol;

namespace {

Symbol read(const std::string& text) {
  const auto symbol = notation::parse_symbol(text);
  INFO(text);
  REQUIRE(symbol);
  return *symbol;
}

std::string canonical_of(const std::string& text) { return notation::to_text(notation::canonical(read(text))); }

}  // namespace

TEST_CASE("symbols are read feature by feature", "[notation]") {
  const Symbol all = read("oo3(12)*2*45xx");
  CHECK(all.handles == 2);
  CHECK(all.cones == std::vector<int>{3, 12});
  CHECK(all.boundaries == std::vector<std::vector<int>>{{2}, {4, 5}});
  CHECK(all.crosscaps == 2);
  CHECK(notation::to_text(all) == "oo3(12)*2*45xx");
  CHECK(read("*o23").boundaries == std::vector<std::vector<int>>{{2, 3}});  // handles may stand anywhere
  CHECK(read("*o23").handles == 1);
  CHECK(read("1*1x").cones.empty());
  CHECK(read("ooo").handles == 3);
  for (const char* text : {"", "2*x∞", "*(3/2)x", "22q", "2**(0)"}) CHECK_FALSE(notation::parse_symbol(text));
}

TEST_CASE("the Euler characteristic is what Conway's bill leaves of 2", "[notation]") {
  for (const auto& [text, chi] : {std::pair{"237", Rational(-1, 42)},
                                  {"*237", Rational(-1, 84)},
                                  {"o", Rational(0)},
                                  {"xx", Rational(0)},
                                  {"22*", Rational(0)},
                                  {"2*22", Rational(0)},
                                  {"4*2", Rational(0)},
                                  {"oo", Rational(-2)},
                                  {"532", Rational(1, 30)},
                                  {"x", Rational(1)},
                                  {"3x", Rational(1, 3)},
                                  {"*22*33", Rational(-7, 6)},
                                  {"*2**3", Rational(-19, 12)}})
    CHECK(notation::euler_characteristic(read(text)) == chi);
  // The seventeen wallpaper groups are those with 0.
  for (const char* text :
       {"o", "2222", "333", "442", "632", "**", "xx", "*x", "22*", "22x", "2*22", "3*3", "4*2", "*2222", "*333", "*442", "*632"})
    CHECK(notation::euler_characteristic(read(text)) == Rational(0));
}

TEST_CASE("all symbols of one orbifold have one canonical form", "[notation]") {
  for (const auto& same : std::vector<std::vector<const char*>>{{"237", "732", "273"},
                                                                {"*237*45", "*54*732", "*45*372", "*54*237"},
                                                                {"ox", "xxx"},
                                                                {"*34xo", "*43xxx"},
                                                                {"*345x", "*543x", "*534x"}})
    for (const char* text : same) CHECK(canonical_of(text) == canonical_of(same[0]));
  // Without a cross-cap boundaries cannot be turned over one by one.
  CHECK(canonical_of("*234*234") != canonical_of("*234*432"));
  CHECK(canonical_of("*234*234x") == canonical_of("*234*432x"));
}

TEST_CASE("bad orbifolds are told, and why", "[notation]") {
  CHECK(notation::why_bad(read("5")).find("single cone point of order 5") != std::string::npos);
  CHECK(notation::why_bad(read("23")).find("2 is not 3") != std::string::npos);
  CHECK(notation::why_bad(read("*4")).find("mirror corner") != std::string::npos);
  CHECK_FALSE(notation::why_bad(read("*34")).empty());
  for (const char* text : {"33", "*33", "5*", "5x", "*5*", "o5", "235", "*"}) CHECK(notation::why_bad(read(text)).empty());
  CHECK(notation::is_orientable(read("o23")));
  CHECK_FALSE(notation::is_orientable(read("2*")));
  CHECK_FALSE(notation::is_orientable(read("xx")));
}
