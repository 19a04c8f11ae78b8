#include "compiler/notation/classify.h"

#include <catch2/catch.hpp>
#include <random>

#include "compiler/notation/euler.h"
#include "compiler/notation/parse.h"
#include "compiler/notation/print.h"

namespace orbc::notation {
namespace {

using geometry::Space;

Orbifold read(const char* text) { return parse(text, {{}, true}).value(); }

TEST_CASE("the Euler characteristic is exact", "[notation]") {
  const std::pair<const char*, Rational> cases[] = {{"*", 1},
                                                    {"**", 0},
                                                    {"*22∞", 0},
                                                    {"*22", Rational(1, 2)},
                                                    {"*77", Rational(1, 7)},
                                                    {"*235", Rational(1, 60)},
                                                    {"*236", 0},
                                                    {"*237", Rational(-1, 84)},
                                                    {"*2222", 0},
                                                    {"*22222", Rational(-1, 4)},
                                                    {"*(3/2)(12)(12)", Rational(-1, 12)}};
  for (const auto& [text, chi] : cases) {
    CAPTURE(text);
    CHECK(euler_characteristic(read(text)) == chi);
  }
  CHECK(euler_characteristic(read("*(1000000)(999999)(999998)")) ==
        (Rational(1, 1000000) + Rational(1, 999999) + Rational(1, 999998)) / 2 - Rational(1, 2));
}

TEST_CASE("the sign of the Euler characteristic is the space", "[notation]") {
  for (const char* text :
       {"*", "*22", "*(1000000)(1000000)", "*222", "*22(1000000)", "*233", "*234", "*235", "*532", "*(3/2)(3/2)", "*(3/2)(3/2)(3/2)"})
    CHECK(*classify(read(text)) == Space::spherical);
  for (const char* text : {"**", "*22∞", "*236", "*362", "*244", "*333", "*2222", "*(3/2)66", "*(3/2)(3/2)33"})
    CHECK(*classify(read(text)) == Space::euclidean);
  for (const char* text :
       {"*237", "*245", "*334", "*2223", "*22222", "*(1000000)(1000000)(1000000)", "*(3/2)(12)(12)", "*(2.5)(2.5)(2.5)(2.5)"})
    CHECK(*classify(read(text)) == Space::hyperbolic);
  // Between E² and its neighbours no float could decide.
  CHECK(*classify(read("*(2000001/1000000)(3)(6)")) == Space::hyperbolic);
  CHECK(*classify(read("*(1999999/1000000)(3)(6)")) == Space::spherical);
}

TEST_CASE("orbifolds that close in no space are bad", "[notation]") {
  for (const Orbifold& o : {Orbifold{{3}, false}, Orbifold{{2, 3}, false}, Orbifold{{Rational(3, 2), 2}, false},
                            Orbifold{{Rational(21, 20), 10, 100}, false}}) {
    CAPTURE(to_text(o));
    const auto space = classify(o);
    REQUIRE_FALSE(space.has_value());
    CHECK(space.error().front().code == "notation.bad-orbifold");
  }
}

TEST_CASE("corners that are none are refused", "[notation]") {
  for (const Rational& corner : {Rational(1), Rational(0), Rational(-2), Rational(1, 2), Rational(1000001)})
    CHECK(classify({{corner, 2, 2}, false}).error().front().code == "notation.order-out-of-range");
  CHECK(classify({std::vector<Rational>(257, 2), false}).error().front().code == "notation.too-many-corners");
}

TEST_CASE("the canonical form is the same for all rotations and reflections and the smallest", "[notation]") {
  for (const char* text : {"*236", "*362", "*623", "*632", "*326", "*263"}) CHECK(to_text(canonical(read(text))) == "*236");
  CHECK(to_text(canonical(read("*2354"))) == "*2354");
  CHECK(to_text(canonical(read("*5324"))) == "*2354");
  CHECK(to_text(canonical(read("*3(3/2)2"))) == "*(3/2)23");
  CHECK(canonical(read("**")).strip);
  CHECK(canonical(read("*2∞2")) == read("*22∞"));
  std::mt19937 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    Orbifold o;
    for (std::size_t n = 3 + random() % 7; n > 0; --n) o.corners.emplace_back(static_cast<int>(2 + random() % 3));
    const Orbifold smallest = canonical(o);
    CHECK(canonical(smallest) == smallest);
    Orbifold turned = o;
    std::rotate(turned.corners.begin(), turned.corners.begin() + static_cast<std::ptrdiff_t>(random() % o.corners.size()),
                turned.corners.end());
    if (random() % 2 == 0) std::reverse(turned.corners.begin(), turned.corners.end());
    CHECK(canonical(turned) == smallest);
    CHECK_FALSE(
        std::lexicographical_compare(turned.corners.begin(), turned.corners.end(), smallest.corners.begin(), smallest.corners.end()));
    CHECK(*classify(turned) == *classify(smallest));
  }
}

}  // namespace
}  // namespace orbc::notation
