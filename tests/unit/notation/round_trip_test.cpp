// What is accepted can be printed and read again: parse ∘ print is the identity.
#include <catch2/catch.hpp>
#include <random>

#include "compiler/notation/parse.h"
#include "compiler/notation/print.h"

namespace orbc::notation {
namespace {

/// A corner as an author may write it: small and large integers, fractions, decimals close to integers, leading zeros.
std::string random_corner(std::mt19937_64& random) {
  const auto up_to = [&](std::uint64_t most) { return random() % most + 1; };
  const auto digits = [&](std::uint64_t count) {
    std::string text;
    for (std::uint64_t i = 0; i < count; ++i) text += static_cast<char>('0' + random() % 10);
    return text;
  };
  switch (random() % 8) {
    case 0: return std::to_string(up_to(9));
    case 1: return "(" + std::to_string(up_to(1'000'000)) + ")";
    case 2: return "(0" + std::to_string(up_to(999)) + ")";
    case 3: return "(" + std::to_string(up_to(9'999'999)) + "/" + std::to_string(up_to(9'999'999)) + ")";
    case 4: return "(" + std::to_string(up_to(99'999'999'999'999)) + "/" + std::to_string(up_to(99'999'999)) + ")";
    case 5: return "(" + std::to_string(up_to(999'999)) + "." + digits(up_to(7)) + ")";
    case 6: return "(" + std::to_string(up_to(9)) + ".000000" + std::to_string(up_to(9)) + ")";
    default: return "(" + std::to_string(up_to(30)) + "/" + std::to_string(up_to(12)) + ")";
  }
}

}  // namespace

TEST_CASE("what is accepted is accepted again as it is printed, and means the same", "[notation]") {
  const ParseOptions real{{}, true};
  for (const char* text : {"*(2.0000001)33", "*(999999.9999999)22", "*(99999998999999/99999999)33", "*2.5 4 4", "*(1)(1)", "*1", "**"}) {
    const auto once = parse(text, real);
    if (!once) continue;   // "*2.5 4 4" wants parentheses
    INFO(text << " is printed as " << to_text(*once));
    const auto twice = parse(to_text(*once), real);
    REQUIRE(twice);
    CHECK(*twice == *once);
  }
  REQUIRE(parse("*(2.0000001)33", real));
  std::mt19937_64 random(20261130);
  int accepted = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string text = "*";
    for (std::uint64_t corner = random() % 7; corner > 0; --corner) text += random_corner(random);
    const auto once = parse(text, real);
    if (!once) continue;
    ++accepted;
    for (const Orbifold& o : {*once, canonical(*once)}) {
      const auto twice = parse(to_text(o), real);
      INFO(text << " is printed as " << to_text(o));
      REQUIRE(twice);
      REQUIRE(*twice == o);
      REQUIRE(to_text(*twice) == to_text(o));
    }
  }
  CHECK(accepted > 5'000);
  // The longest that there is.
  Orbifold longest;
  longest.corners.assign(kMaxCorners, Rational(Integer("99999998999999"), Integer("99999999")));
  REQUIRE(parse(to_text(longest), real));
  CHECK(*parse(to_text(longest), real) == longest);
}

}  // namespace orbc::notation
