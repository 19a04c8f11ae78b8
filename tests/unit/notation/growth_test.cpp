#include "compiler/notation/growth.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "compiler/notation/classify.h"
#include "compiler/notation/euler.h"
#include "compiler/notation/parse.h"
#include "compiler/notation/print.h"
#include "tests/reference/growth.h"

namespace orbc::notation {
namespace {

Orbifold read(std::string_view text) { return parse(text).value(); }

std::vector<Integer> integers(const std::vector<std::int64_t>& list) { return {list.begin(), list.end()}; }

std::vector<Integer> expanded(const GrowthSeries& series, int max_length) {
  std::vector<Integer> coefficients;
  for (std::size_t n = 0; n <= static_cast<std::size_t>(max_length); ++n) {
    Integer sum = n < series.numerator.size() ? series.numerator[n] : Integer(0);
    for (std::size_t j = 1; j <= n && j < series.denominator.size(); ++j) sum -= series.denominator[j] * coefficients[n - j];
    coefficients.push_back(sum);
  }
  return coefficients;
}

Integer at_one(const std::vector<Integer>& polynomial) {
  Integer sum = 0;
  for (const Integer& c : polynomial) sum += c;
  return sum;
}

TEST_CASE("growth series, counts, orders and rates equal the reference", "[notation]") {
  CHECK(reference::growth().size() >= 28);
  for (const reference::Growth& group : reference::growth()) {
    CAPTURE(group.notation);
    const Orbifold o = read(group.notation);
    const GrowthSeries series = growth_series(o).value();
    CHECK(series.numerator == integers(group.numerator));
    CHECK(series.denominator == integers(group.denominator));
    CHECK(copies_per_length(o, static_cast<int>(group.per_length.size()) - 1) == integers(group.per_length));
    CHECK(group_order(o).value_or(0) == group.order);
    CHECK(growth_rate(o).has_value() == (group.order == 0));
    if (group.order == 0) CHECK(*growth_rate(o) == Approx(group.rate).epsilon(1e-14));
  }
}

TEST_CASE("the growth rate of *237 is Lehmer's number to the last bit", "[notation]") {
  CHECK(*growth_rate(read("*237")) == 1.17628081825991750654);
  CHECK(*growth_rate(read("*372")) == 1.17628081825991750654);
  CHECK(*growth_rate(read("*22222")) == (3 + std::sqrt(5.0)) / 2);
  CHECK(*growth_rate(read("*222222")) == 2 + std::sqrt(3.0));
  CHECK(*growth_rate(read("*333")) == 1);
  CHECK(*growth_rate(read("**")) == 1);
  CHECK_FALSE(growth_rate(read("*235")).has_value());
}

TEST_CASE("finite groups have their orders and longest elements", "[notation]") {
  const std::tuple<const char*, int, int> cases[] = {{"*", 2, 1},     {"*22", 4, 2},       {"*77", 14, 7},
                                                     {"*222", 8, 3},  {"*22(10)", 40, 11}, {"*2(10)2", 40, 11},
                                                     {"*332", 24, 6}, {"*432", 48, 9},     {"*352", 120, 15}};
  for (const auto& [text, order, longest] : cases) {
    CAPTURE(text);
    CHECK(*group_order(read(text)) == order);
    CHECK(*longest_length(read(text)) == longest);
    CHECK(copies_up_to(read(text), 1000) == order);
    CHECK(static_cast<int>(copies_per_length(read(text), 1000).size()) == longest + 1);
    CHECK(copies_per_length(read(text), 1000).back() == 1);
  }
  CHECK(*group_order(read("*(1000000)(1000000)")) == 2000000);
  CHECK(*longest_length(read("*22(1000000)")) == 1000001);
  CHECK_FALSE(growth_series(read("*22(1000000)")).has_value());
  CHECK_FALSE(group_order(read("*237")).has_value());
  CHECK_FALSE(longest_length(read("*333")).has_value());
}

TEST_CASE("counts are those known from elsewhere", "[notation]") {
  CHECK(copies_per_length(read("*237"), 60)[37] == 2818);
  CHECK(copies_per_length(read("*666"), 15)[15] == 37239);
  for (const auto& [length, copies] : {std::pair{0, 1}, {1, 6}, {2, 21}, {3, 61}, {4, 166}})
    CHECK(copies_up_to(read("*22222"), length) == copies);
  CHECK(copies_per_length(read("**"), 4) == std::vector<Integer>{1, 2, 2, 2, 2});
  CHECK(copies_per_length(read("*22∞"), 4) == std::vector<Integer>{1, 3, 4, 4, 4});
  CHECK(copies_per_length(read("*237"), 0) == std::vector<Integer>{1});
}

TEST_CASE("the rational function and the counts are one series", "[notation]") {
  for (const char* text : {"*237", "*732", "*666", "*2223", "*22222", "*23456789(10)(11)", "*(12)(18)(30)", "*2(210)(330)", "**", "*22∞",
                           "*333", "*3(30)3(30)"}) {
    CAPTURE(text);
    CHECK(expanded(growth_series(read(text)).value(), 300) == copies_per_length(read(text), 300));
  }
}

TEST_CASE("one over the growth series at 1 is the Euler characteristic", "[notation]") {
  std::mt19937 random(11);
  for (int trial = 0; trial < 200; ++trial) {
    Orbifold o;
    for (std::size_t n = 3 + random() % 6; n > 0; --n) o.corners.emplace_back(static_cast<int>(2 + random() % 11));
    CAPTURE(to_text(o));
    const GrowthSeries series = growth_series(o).value();
    const Rational at_1(at_one(series.denominator), at_one(series.numerator));
    CHECK(at_1 == (group_order(o) ? Rational(1, *group_order(o)) : euler_characteristic(o)));
    CHECK(series.numerator.front() == 1);
    CHECK(series.denominator.front() == 1);
    // A product of cyclotomic polynomials reads the same from both ends.
    std::vector<Integer> backwards(series.numerator.rbegin(), series.numerator.rend());
    CHECK(backwards == series.numerator);
  }
}

TEST_CASE("the growth rate is where the counts lead", "[notation]") {
  for (const char* text : {"*238", "*245", "*334", "*2223", "*22223", "*(20)(20)(20)", "*23(1000)", "*23456789(10)(11)"}) {
    CAPTURE(text);
    const std::vector<Integer> copies = copies_per_length(read(text), 400);
    const double ratio = static_cast<double>(Rational(copies[400], copies[399]));
    CHECK(*growth_rate(read(text)) == Approx(ratio).epsilon(1e-6));
  }
}

TEST_CASE("rooms with forty corners of forty orders have their series", "[notation]") {
  Orbifold o;
  for (int k = 2; k <= 41; ++k) o.corners.emplace_back(k);
  const GrowthSeries series = growth_series(o).value();
  CHECK(series.numerator.size() == 531);
  CHECK(expanded(series, 100) == copies_per_length(o, 100));
  CHECK(Rational(at_one(series.denominator), at_one(series.numerator)) == euler_characteristic(o));
  CHECK(copies_per_length(o, 2) == std::vector<Integer>{1, 40, 40 * 39 - 1});
}

TEST_CASE("long lists are counted as well", "[notation]") {
  CHECK(copies_up_to(read("*333"), 5000) == 1 + 3 * Integer(5000) * 5001 / 2);
  CHECK(copies_per_length(read("*22222"), 1000)[1000] ==
        3 * copies_per_length(read("*22222"), 999)[999] - copies_per_length(read("*22222"), 998)[998]);
  CHECK(copies_up_to(read("**"), 1000000) == 2000001);
  CHECK(copies_up_to(read("*22∞"), 1000000) == 4000000);
}

TEST_CASE("huge orders are counted as well", "[notation]") {
  CHECK(copies_per_length(read("*23(1000000)"), 20) == copies_per_length(read("*23(100)"), 20));
  CHECK_FALSE(growth_series(read("*23(1000000)")).has_value());
  CHECK(*growth_rate(read("*23(1000000)")) == Approx(1.3247179572447460).epsilon(1e-14));  // the plastic number, of *23∞
}

}  // namespace
}  // namespace orbc::notation
