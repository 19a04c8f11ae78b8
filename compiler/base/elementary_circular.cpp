// sin, cos, tan: reduction by π/2 in three pieces (Cody and Waite, Software manual for the elementary functions, 1980), polynomials by
// interpolation at Chebyshev nodes, errors below 1e-17. atan: the nearest 64th from a table and the addition theorem. asin: a polynomial up
// to ½, beyond it of half the angle.
#include <array>
#include <limits>

#include "compiler/base/elementary.h"
#include "compiler/base/pair.h"

namespace orbc::math {
namespace {

constexpr double kQuarter = 0x1.921fb54442d18p-1;  // π/4
constexpr Pair kHalfPi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

template <std::size_t N>
double polynomial(double y, const double (&c)[N]) {
  double sum = c[N - 1];
  for (std::size_t i = N - 1; i-- > 0;) sum = sum * y + c[i];
  return sum;
}

/// An angle = rest + quadrant · π/2, with the rest in [−π/4, π/4] and the quadrant modulo 4.
struct Reduced {
  Pair rest;
  int quadrant = 0;
};

Reduced reduce(double x) {
  if (std::fabs(x) <= kQuarter) return {{x, 0}, 0};
  if (!(std::fabs(x) < 0x1p20)) x = std::fmod(x, 4 * kHalfPi.high);  // NaN of infinities
  constexpr double kMagic = 0x1.8p52, kPerQuadrant = 0.63661977236758138;
  // 33 bits each: their products with n < 2^20 are exact.
  constexpr double kFirst = 0x1.921fb544p+0, kSecond = 0x1.0b4611a6p-34, kThird = 0x1.3198a2e037073p-69;
  const double n = (x * kPerQuadrant + kMagic) - kMagic;
  const Pair t = sum_of(x - n * kFirst, -(n * kSecond));
  return {fast_sum_of(t.high, t.low - n * kThird), x == x ? static_cast<int>(static_cast<long long>(n) & 3) : 0};
}

/// sin and cos of high + low in [−π/4, π/4], as unevaluated sums.
Pair sine_of(const Pair& r) {
  static constexpr double kSine[] = {-0.16666666666666666,   0.008333333333333331,  -0.00019841269841265063, 2.7557319219337312e-06,
                                     -2.5052106231802837e-08, 1.6058531516797758e-10, -7.586691094197958e-13};
  const double y = r.high * r.high;
  return {r.high, r.high * y * polynomial(y, kSine) + r.low * (1 - 0.5 * y)};
}
Pair cosine_of(const Pair& r) {
  static constexpr double kCosine[] = {0.041666666666666664,   -0.0013888888888887398, 2.480158729876456e-05,
                                       -2.7557317271145144e-07, 2.087614614655861e-09,  -1.1382623647474604e-11};
  const double y = r.high * r.high, half = 0.5 * y, top = 1 - half;
  return {top, ((1 - top) - half) + (y * y * polynomial(y, kCosine) - r.high * r.low)};
}

double value(const Pair& x) { return x.high + x.low; }

constexpr int kArcNodes = 64;            // of the interval [0, 1]

constexpr std::array<Pair, kArcNodes + 1> make_arcs() {  // atan x = Σ 4^n n!²/(2n+1)! · x^(2n+1)/(1 + x²)^(n+1) (Euler)
  std::array<Pair, kArcNodes + 1> arcs{};
  for (int i = 0; i <= kArcNodes; ++i) {
    const double x = i / static_cast<double>(kArcNodes), square = x * x;
    const Pair ratio = divide({square, 0}, {1 + square, 0});
    Pair sum{1, 0};
    for (int n = 110; n > 0; --n) sum = add({1, 0}, multiply(multiply(sum, ratio), divide({2.0 * n, 0}, {2.0 * n + 1, 0})));
    arcs[static_cast<std::size_t>(i)] = multiply(sum, divide({x, 0}, {1 + square, 0}));
  }
  return arcs;
}
constexpr std::array<Pair, kArcNodes + 1> kArcs = make_arcs();

/// atan(small/big) for 0 ≤ small ≤ big, big > 0 and neither very large nor very small.
Pair arc_of(double small, double big) {
  static constexpr double kSeries[] = {-1.0 / 3, 1.0 / 5, -1.0 / 7, 1.0 / 9, -1.0 / 11};
  const int i = static_cast<int>(small / big * kArcNodes + 0.5);
  if (i < 2) {  // below 1/42 the quotient's own rounding would count
    const double t = small / big, y = t * t;
    const Pair back = product_of(t, big);
    return {t, ((small - back.high) - back.low) / big + t * y * polynomial(y, kSeries)};
  }
  // (small − node·big)/(big + node·small): the node has 6 bits, so both halves of big give exact products.
  const double node = i * (1.0 / kArcNodes), ah = 134217729 * big, top = ah - (ah - big), bottom = big - top;
  const double t = ((small - node * top) - node * bottom) / (big + node * small), y = t * t;
  const Pair& arc = kArcs[static_cast<std::size_t>(i)];
  return fast_sum_of(arc.high, arc.low + (t + t * y * polynomial(y, kSeries)));
}

/// a − b for a > b, rounded.
Pair less(const Pair& a, const Pair& b) { return add(a, {-b.high, -b.low}); }

/// asin x − x for 0 ≤ x ≤ ½.
double asin_tail(double x) {
  static constexpr double kSeries[] = {0.16666666666666669,  0.07499999999998433,  0.04464285714635545,  0.030381944138529803,
                                       0.022372172942209625, 0.017352392719417624, 0.01397121299584485,  0.01147917719077423,
                                       0.010322815852320064, 0.005457500096744011, 0.017400897906395946, -0.01485191657576524,
                                       0.0287578719503479};
  return x * (x * x) * polynomial(x * x, kSeries);
}

/// 2 asin √((1 − x)/2), which is acos x, for ½ < x ≤ 1.
Pair acos_near_one(double x) {
  const double half = 0.5 * (1 - x), root = std::sqrt(half);  // exact
  if (half == 0) return {0, 0};
  const Pair square = product_of(root, root);
  const double low = ((half - square.high) - square.low) / (2 * root);
  return fast_sum_of(2 * root, 2 * (low + asin_tail(root)));
}

}  // namespace

double sin(double x) { return sin_cos(x).sine; }

double cos(double x) { return sin_cos(x).cosine; }

SineCosine sin_cos(double x) {
  const Reduced r = reduce(x);
  const double sine = r.rest.high == 0 ? r.rest.high : value(sine_of(r.rest)), cosine = value(cosine_of(r.rest));
  switch (r.quadrant) {
    case 0: return {sine, cosine};
    case 1: return {cosine, -sine};
    case 2: return {-sine, -cosine};
    default: return {-cosine, sine};
  }
}

double tan(double x) {
  const Reduced r = reduce(x);
  if (r.rest.high == 0) return x;
  const Pair s = sine_of(r.rest), c = cosine_of(r.rest);
  const Pair sine = fast_sum_of(s.high, s.low), cosine = fast_sum_of(c.high, c.low);
  return r.quadrant & 1 ? -value(divide(cosine, sine)) : value(divide(sine, cosine));
}

double asin(double x) {
  const double size = std::fabs(x);
  if (size <= 0.5) return x + asin_tail(x);
  if (!(size <= 1)) return std::numeric_limits<double>::quiet_NaN();
  return std::copysign(value(less(kHalfPi, acos_near_one(size))), x);
}

double acos(double x) {
  const double size = std::fabs(x);
  if (size <= 0.5) {
    const double tail = asin_tail(x);
    const Pair turned = sum_of(kHalfPi.high, -x);
    return turned.high + (turned.low + (kHalfPi.low - tail));
  }
  if (!(size <= 1)) return std::numeric_limits<double>::quiet_NaN();
  const Pair near = acos_near_one(size);
  return value(x > 0 ? near : less({2 * kHalfPi.high, 2 * kHalfPi.low}, near));
}

double atan(double x) { return std::copysign(atan2(std::fabs(x), 1), x); }

double atan2(double y, double x) {
  double up = std::fabs(y), side = std::fabs(x);
  if (up != up || side != side) return x + y;
  const bool steep = up > side, infinite = std::fabs(steep ? up : side) == std::numeric_limits<double>::infinity();
  if (infinite) up = up > 1e308 && std::isinf(up), side = std::isinf(side);
  double small = steep ? side : up, big = steep ? up : side;
  Pair angle{0, 0};
  if (small != 0) {
    if (big > 1e300) small *= 0x1p-100, big *= 0x1p-100;
    if (big < 1e-200) small *= 0x1p300, big *= 0x1p300;
    angle = small < big * 0x1p-60 ? Pair{small / big, 0} : arc_of(small, big);
  }
  if (steep) angle = less(kHalfPi, angle);
  if (std::signbit(x)) angle = less({2 * kHalfPi.high, 2 * kHalfPi.low}, angle);
  return std::copysign(value(angle), y);
}

}  // namespace orbc::math
