#include "compiler/base/elementary.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <string>

using namespace orbc;

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// How far `got` is from `want`, in ulp of a double there. The reference is the C library's long double: 11 bits more.
double ulps(double got, long double want) {
  const double near = std::fabs(static_cast<double>(want));
  if (near == kInfinite || near == 0) return got == static_cast<double>(want) ? 0 : kInfinite;
  const double ulp = std::nextafter(near, kInfinite) - near;
  return static_cast<double>(std::fabs((static_cast<long double>(got) - want) / ulp));
}

using Random = std::mt19937_64;

double even(Random& random, double low, double high) { return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53); }
/// Of either sign, its logarithm even.
double spread(Random& random, double low, double high) {
  const double size = std::exp2(even(random, std::log2(low), std::log2(high)));
  return random() & 1 ? size : -size;
}

using Function = double (*)(double);
using Reference = long double (*)(long double);

struct Case {
  std::string name;
  Function function;
  Reference reference;
  std::function<double(Random&)> argument;
};

std::function<double(Random&)> between(double low, double high) {
  return [=](Random& random) { return even(random, low, high); };
}
std::function<double(Random&)> sized(double low, double high) {
  return [=](Random& random) { return spread(random, low, high); };
}
std::function<double(Random&)> positive(double low, double high) {
  return [=](Random& random) { return std::fabs(spread(random, low, high)); };
}

std::vector<Case> cases() {
  return {{"sin", math::sin, std::sin, between(-7, 7)},           {"sin", math::sin, std::sin, sized(1e-10, 1e6)},
          {"cos", math::cos, std::cos, between(-7, 7)},           {"cos", math::cos, std::cos, sized(1e-10, 1e6)},
          {"tan", math::tan, std::tan, between(-7, 7)},           {"tan", math::tan, std::tan, sized(1e-10, 1e6)},
          {"asin", math::asin, std::asin, between(-1, 1)},        {"asin", math::asin, std::asin, sized(1e-10, 0.6)},
          {"acos", math::acos, std::acos, between(-1, 1)},        {"acos", math::acos, std::acos, between(0.999999, 1)},
          {"atan", math::atan, std::atan, between(-2, 2)},        {"atan", math::atan, std::atan, sized(1e-8, 1e8)},
          {"exp", math::exp, std::exp, between(-5, 5)},           {"exp", math::exp, std::exp, between(-708, 709)},
          {"exp2", math::exp2, std::exp2, between(-5, 5)},        {"exp2", math::exp2, std::exp2, between(-1020, 1023)},
          {"log", math::log, std::log, between(0.5, 2)},          {"log", math::log, std::log, positive(1e-310, 1e300)},
          {"log1p", math::log1p, std::log1p, between(-0.9, 2)},   {"log1p", math::log1p, std::log1p, sized(1e-12, 0.9)},
          {"log2", math::log2, std::log2, between(0.5, 2)},       {"log2", math::log2, std::log2, positive(1e-310, 1e300)},
          {"log10", math::log10, std::log10, between(0.5, 2)},    {"log10", math::log10, std::log10, positive(1e-310, 1e300)},
          {"cbrt", math::cbrt, std::cbrt, sized(1e-310, 1e300)},  {"sinh", math::sinh, std::sinh, between(-3, 3)},
          {"sinh", math::sinh, std::sinh, sized(1e-10, 710)},     {"cosh", math::cosh, std::cosh, between(-3, 3)},
          {"cosh", math::cosh, std::cosh, sized(1e-10, 710)},     {"tanh", math::tanh, std::tanh, between(-3, 3)},
          {"tanh", math::tanh, std::tanh, sized(1e-10, 30)},      {"asinh", math::asinh, std::asinh, between(-3, 3)},
          {"asinh", math::asinh, std::asinh, sized(1e-10, 1e20)}, {"atanh", math::atanh, std::atanh, between(-1, 1)},
          {"atanh", math::atanh, std::atanh, sized(1e-10, 0.5)}};
}

/// Fowler, Noll, Vo: 64 bits of what all bits say.
struct Hash {
  std::uint64_t value = 0xcbf29ce484222325;
  void operator()(double x) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, 8);
    for (int i = 0; i < 8; ++i) value = (value ^ (bits >> 8 * i & 255)) * 0x100000001b3;
  }
};

}  // namespace

TEST_CASE("elementary functions err by less than one ulp", "[base]") {
  for (const Case& c : cases()) {
    Random random(7);
    double worst = 0, at = 0;
    for (int i = 0; i < 40000; ++i) {
      const double x = c.argument(random), off = ulps(c.function(x), c.reference(x));
      if (!(off <= worst)) worst = off, at = x;
    }
    INFO(c.name << " errs by " << worst << " ulp at " << std::hexfloat << at);
    CHECK(worst < 1);
  }
}

TEST_CASE("functions of two numbers err by less than one ulp, hypot by less than 1.25", "[base]") {
  Random random(9);
  double pow_off = 0, arc_off = 0, hypot_off = 0;
  for (int i = 0; i < 100000; ++i) {
    const double x = spread(random, 1e-3, 1e3), y = spread(random, 1e-3, 1e3), power = even(random, -20, 20);
    pow_off = std::max(pow_off, ulps(math::pow(std::fabs(x), power), std::pow(std::fabs(static_cast<long double>(x)), power)));
    arc_off = std::max(arc_off, ulps(math::atan2(x, y), std::atan2(static_cast<long double>(x), static_cast<long double>(y))));
    hypot_off = std::max(hypot_off, ulps(math::hypot(x, y), std::hypot(static_cast<long double>(x), static_cast<long double>(y))));
  }
  CHECK(pow_off < 1);
  CHECK(arc_off < 1);
  CHECK(hypot_off < 1.25);
}

TEST_CASE("elementary functions are exact where the result is", "[base]") {
  for (int n = -20; n <= 22; ++n)
    if (n >= 0) CHECK(math::pow(10, n) == std::stod("1e" + std::to_string(n)));
  for (int n = -1074; n <= 1023; ++n) {
    CHECK(math::exp2(n) == std::ldexp(1.0, n));
    CHECK(math::log2(std::ldexp(1.0, n)) == n);
    CHECK(math::pow(2, n) == std::ldexp(1.0, n));
  }
  for (int n = 1; n < 100; ++n) CHECK(math::cbrt(n * n * n) == n);
  CHECK(math::pow(-2, 3) == -8);
  CHECK(math::pow(0.3, 2) == 0.3 * 0.3);
  CHECK(math::hypot(3, -4) == 5);
  CHECK(math::hypot(3e200, 4e200) == Approx(5e200).epsilon(1e-15));
  CHECK(math::hypot(0, 1e-310) == 1e-310);
  CHECK(math::abs({3, 4}) == 5);
  CHECK(math::polar(2, 0) == std::complex<double>(2, 0));
  CHECK(math::log10(1000) == 3);
  CHECK(math::cos(0) == 1);
  CHECK(math::tanh(40) == 1);
}

TEST_CASE("special arguments give what the C standard says", "[base]") {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto alike = [](double a, long double b) {
    return (std::isnan(a) && std::isnan(b)) || (a == static_cast<double>(b) && std::signbit(a) == std::signbit(b));
  };
  const double special[] = {0.0, -0.0, 1, -1, kInfinite, -kInfinite, none};
  for (const Case& c : cases())
    for (const double x : special) {
      INFO(c.name << "(" << x << ") is " << c.function(x));
      if (!std::isnan(x) || !std::isnan(c.function(x)))
        CHECK((alike(c.function(x), c.reference(x)) || ulps(c.function(x), c.reference(x)) < 1));
    }
  const double more[] = {0.0, -0.0, 0.5, -0.5, 1, -1, 2, 3, -2, -3, 1e300, -1e300, 1e-300, kInfinite, -kInfinite, none};
  for (const double x : more)
    for (const double y : more) {
      INFO(x << ", " << y);
      CHECK((alike(math::atan2(x, y), std::atan2(x, y)) || ulps(math::atan2(x, y), std::atan2(static_cast<long double>(x), y)) < 1));
      const double want = std::pow(x, y);
      CHECK((alike(math::pow(x, y), want) || ulps(math::pow(x, y), want) < 1));
      CHECK((alike(math::hypot(x, y), std::hypot(x, y)) || ulps(math::hypot(x, y), std::hypot(static_cast<long double>(x), y)) < 1.25));
    }
  CHECK(math::exp(1000) == kInfinite);
  CHECK(math::exp(-1000) == 0);
  CHECK(math::sinh(-1e5) == -kInfinite);
  CHECK(math::cosh(-1e5) == kInfinite);
  CHECK(std::fabs(math::sin(1e300)) <= 1);
}

TEST_CASE("sine and cosine together have the bits of each alone", "[base]") {
  Random random(3);
  for (int i = 0; i < 10000; ++i) {
    const double x = spread(random, 1e-5, 1e5);
    const math::SineCosine both = math::sin_cos(x);
    CHECK((both.sine == math::sin(x) && both.cosine == math::cos(x)));
    CHECK((math::sin(-x) == -both.sine && math::cos(-x) == both.cosine));
  }
}

// The value is whatever the first machine gave; what counts is that all others give it, too: GCC and Clang, with fused multiply-add and
// without, whatever the C library. A change of a function changes it, and every file that orbc writes: then take the new value over.
TEST_CASE("elementary functions have the same bits on every machine", "[base]") {
  Hash hash;
  for (const Case& c : cases()) {
    std::uint64_t state = 1;
    for (int i = 0; i < 2000; ++i) {
      state = state * 6364136223846793005 + 1442695040888963407;
      hash(c.function((static_cast<double>(state >> 11) * 0x1p-53 - 0.5) * (c.name == "exp" ? 40 : 1.9)));
    }
  }
  CHECK(hash.value == 0xc755a443d5df1987);
}
