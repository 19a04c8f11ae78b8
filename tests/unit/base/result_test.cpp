#include "compiler/base/result.h"

#include <catch2/catch.hpp>
#include <memory>

#include "compiler/base/angle.h"
#include "compiler/base/executor.h"
#include "compiler/base/progress.h"
#include "compiler/base/rational.h"

namespace orbc {
namespace {

Result<int> halved(int value) {
  if (value % 2) return make_error("test.odd", "odd number");
  return value / 2;
}

TEST_CASE("a result is a value or the reasons why there is none", "[base]") {
  const Result<int> good = halved(4), bad = halved(3);
  CHECK(good.has_value());
  CHECK(*good == 2);
  CHECK_FALSE(bad);
  REQUIRE(bad.error().size() == 1);
  CHECK(bad.error()[0].code == "test.odd");
}

TEST_CASE("a result holds what can only be moved", "[base]") {
  Result<std::unique_ptr<int>> result(std::make_unique<int>(7));
  CHECK(**result == 7);
  const std::unique_ptr<int> taken = *std::move(result);
  CHECK(*taken == 7);
}

TEST_CASE("degrees and radians agree", "[base]") {
  CHECK(Angle::from_degrees(180).radians == Approx(std::numbers::pi));
  CHECK(Angle::from_degrees(75).degrees() == Approx(75));
}

TEST_CASE("rationals print as fractions in lowest terms", "[base]") {
  CHECK(to_string(Rational(-2, 168)) == "-1/84");
  CHECK(to_string(Rational(4, 2)) == "2");
  CHECK(to_string(Rational(0)) == "0");
}

TEST_CASE("the serial executor runs every task once, in order", "[base]") {
  std::vector<std::size_t> ran;
  serial_executor()(5, [&](std::size_t i) { ran.push_back(i); });
  CHECK(ran == std::vector<std::size_t>{0, 1, 2, 3, 4});
}

TEST_CASE("progress reports, and stops when asked to", "[base]") {
  std::uint64_t seen = 0;
  std::atomic<bool> stop = false;
  Progress progress{[&](std::string_view, std::uint64_t done, std::uint64_t, std::string_view) { seen = done; }, &stop};
  report(progress, "bending", 3, 10);
  CHECK(seen == 3);
  stop = true;
  CHECK_THROWS_AS(report(progress, "bending", 4, 10), Cancelled);
  report({}, "nobody listens", 1, 2);
}

}  // namespace
}  // namespace orbc
