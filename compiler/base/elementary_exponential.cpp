// exp and log by tables of 128 entries and short polynomials (Tang, Table-driven implementation of the exponential function, 1989, and of
// the logarithm, 1990). Results have a low part, so that pow, the hyperbolic functions and their inverses are as accurate. The compiler
// computes the tables from the series, in pairs.
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>

#include "compiler/base/elementary.h"
#include "compiler/base/pair.h"

namespace orbc::math {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity(), kNone = std::numeric_limits<double>::quiet_NaN();
constexpr Pair kLn2 = {0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};

std::uint64_t bits_of(double x) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &x, 8);
  return bits;
}
double from_bits(std::uint64_t bits) {
  double x = 0;
  std::memcpy(&x, &bits, 8);
  return x;
}
/// 2^k for −1022 ≤ k ≤ 1023.
double power_of_two(int k) { return from_bits(static_cast<std::uint64_t>(k + 1023) << 52); }

// ---- exp ---------------------------------------------------------------------------------------------------------------------------

constexpr int kParts = 128;           // of an octave

constexpr std::array<Pair, kParts> make_powers() {  // 2^(j/128) by the series of exp
  std::array<Pair, kParts> powers{};
  for (int j = 0; j < kParts; ++j) {
    const Pair x = multiply(kLn2, {j / static_cast<double>(kParts), 0});
    Pair sum{1, 0};
    for (int n = 28; n > 0; --n) sum = add({1, 0}, divide(multiply(sum, x), {static_cast<double>(n), 0}));
    powers[static_cast<std::size_t>(j)] = sum;
  }
  return powers;
}
constexpr std::array<Pair, kParts> kPowers = make_powers();

/// A positive number as (high + low)·2^k with high in [1, 2).
struct Scaled {
  Pair mantissa;
  int k = 0;
};

/// exp(x + low). In: |x| < 1100, |low| far below 1.
Scaled exp_of(double x, double low) {
  constexpr double kMagic = 0x1.8p52, kPerPart = kParts / 0.69314718055994531;
  constexpr double kPartHigh = 0x1.62e42fef8p-8, kPartLow = 0x1.1cf79abc9e3b4p-43;  // ln 2/128; the high part times n is exact
  const double n = (x * kPerPart + kMagic) - kMagic;
  const auto whole = static_cast<std::int64_t>(n);
  const double r = ((x - n * kPartHigh) - n * kPartLow) + low;
  const Pair& t = kPowers[static_cast<std::size_t>(whole & (kParts - 1))];
  const double p = r + r * r * (0.5 + r * (1.0 / 6 + r * (1.0 / 24 + r * (1.0 / 120))));
  return {fast_sum_of(t.high, t.low + t.high * p), static_cast<int>(whole >> 7)};
}

/// (high + low)·2^k, rounded, with overflow and underflow as in IEEE 754.
double rounded(const Scaled& x) {
  const double m = x.mantissa.high + x.mantissa.low;
  if (x.k > -1022 && x.k < 1023) return from_bits(bits_of(m) + (static_cast<std::uint64_t>(static_cast<std::int64_t>(x.k)) << 52));
  if (x.k > 1100) return kInfinite;
  if (x.k < -1100) return 0;
  const int half = x.k / 2;
  return m * power_of_two(half) * power_of_two(x.k - half);
}

// ---- log ---------------------------------------------------------------------------------------------------------------------------

/// For an interval of mantissas: the inverse of a number near it, a multiple of 1/128, and the negative logarithm of this inverse, whose
/// high part is a multiple of 2^-42.
struct Node {
  double inverse = 1;
  Pair log;
};

constexpr int kFirstBelowOne = 53;    // mantissas from 1 + 53/128 = 1.414 on are halved

constexpr std::array<Node, kParts> make_nodes() {
  std::array<Node, kParts> nodes{};
  for (int i = 0; i < kParts; ++i) {
    const double middle = (1 + (i + 0.5) / kParts) * (i >= kFirstBelowOne ? 0.5 : 1);
    const int inverse = i == 0 ? kParts : static_cast<int>(kParts / middle + 0.5);
    // −log(inverse/128) = −2 atanh s, s = (inverse − 128)/(inverse + 128).
    const Pair s = divide({static_cast<double>(inverse - kParts), 0}, {static_cast<double>(inverse + kParts), 0}), y = multiply(s, s);
    Pair sum{};
    for (int n = 41; n > 0; n -= 2) sum = add(multiply(sum, y), divide({1, 0}, {static_cast<double>(n), 0}));
    Pair log = multiply(multiply(sum, s), {-2, 0});
    constexpr double kRound = 0x1.8p10;  // 1.5·2^(52 − 42)
    const double high = (log.high + kRound) - kRound;
    log = {high, (log.high - high) + log.low};
    nodes[static_cast<std::size_t>(i)] = {inverse / static_cast<double>(kParts), log};
  }
  return nodes;
}
constexpr std::array<Node, kParts> kNodes = make_nodes();

/// r³/3 − r⁴/4 + … for |r| < 0.01.
double cubic_tail(double r) {
  return r * r * r * ((1.0 / 3 - r * (1.0 / 4)) + r * r * ((1.0 / 5 - r * (1.0 / 6)) + r * r * (1.0 / 7 - r * (1.0 / 8))));
}

/// The terms of log(x + low) = (exact + r) + rest − r²/2 + r³/3 − ….
struct LogParts {
  double exact = 0, r = 0, rest = 0;
};

/// In: x positive, finite and normal; |low| at most an ulp of it.
LogParts log_parts(double x, double low) {
  constexpr double kLn2High = 0x1.62e42fefa38p-1, kLn2Low = 0x1.ef35793c7673p-45;  // the high part a multiple of 2^-42
  const std::uint64_t bits = bits_of(x);
  const auto i = static_cast<int>(bits >> 45 & 127);
  const int k = static_cast<int>(bits >> 52) - 1023 + (i >= kFirstBelowOne);
  const double z = from_bits((bits & 0x000fffffffffffff) | (i >= kFirstBelowOne ? 0x3fe0000000000000 : 0x3ff0000000000000));
  const Node& node = kNodes[static_cast<std::size_t>(i)];
  // r = z·inverse − 1 without rounding: the inverse has 8 bits, so both halves of z give exact products.
  const double top = from_bits(bits_of(z) & 0xfffffffff8000000), bottom = z - top;
  LogParts parts;
  parts.r = (top * node.inverse - 1) + bottom * node.inverse;
  parts.exact = k * kLn2High + node.log.high;
  parts.rest = k * kLn2Low + node.log.low;
  if (low != 0) parts.rest += low / x;
  return parts;
}

double rounded(const LogParts& parts) {
  const Pair s = sum_of(parts.exact, parts.r);
  return s.high + (s.low + (parts.rest + (cubic_tail(parts.r) - 0.5 * parts.r * parts.r)));
}

/// Relative error: about 2^-67.
Pair paired(const LogParts& parts) {
  const Pair s = sum_of(parts.exact, parts.r), square = product_of(parts.r, parts.r);
  const Pair t = sum_of(s.high, -0.5 * square.high);
  return fast_sum_of(t.high, t.low + (s.low + ((parts.rest - 0.5 * square.low) + cubic_tail(parts.r))));
}

/// What log gives that is no ordinary case. Makes: whether it is one; a subnormal is scaled up, `k` says by how much.
bool is_special(double& x, double& result, int& k) {
  if (x >= std::numeric_limits<double>::min() && x < kInfinite) return false;
  if (x > 0 && x < 1) return x *= 0x1p54, k = -54, false;
  result = x == 0 ? -kInfinite : x > 0 ? kInfinite : kNone;
  return true;
}

/// log(1 + x + low) for |x| < 1/256.
double log_beside_one(double x, double low) { return x + (low + (cubic_tail(x) - 0.5 * x * x)); }

constexpr double kBesideOne = 1.0 / 256;

double log_of_pair(const Pair& x) { return rounded(log_parts(x.high, x.low)); }

template <std::size_t N>
double series(double y, const double (&c)[N]) {
  double sum = c[N - 1];
  for (std::size_t i = N - 1; i-- > 0;) sum = sum * y + c[i];
  return sum;
}

/// √(x² + 1) as a pair. In: |x| < 2^28.
Pair root_of_square_and_one(double x) {
  const Pair square = product_of(x, x), sum = sum_of(square.high, 1), one = fast_sum_of(sum.high, sum.low + square.low);
  const double root = std::sqrt(one.high);
  const Pair again = product_of(root, root);
  return {root, (((one.high - again.high) - again.low) + one.low) / (2 * root)};
}

}  // namespace

double exp(double x) {
  if (!(x < 1000)) return x != x ? x : kInfinite;
  if (x < -1000) return 0;
  return rounded(exp_of(x, 0));
}

double exp2(double x) {
  if (!(x < 1100)) return x != x ? x : kInfinite;
  if (x < -1100) return 0;
  constexpr double kMagic = 0x1.8p52;
  const double n = (x * kParts + kMagic) - kMagic;
  const auto whole = static_cast<std::int64_t>(n);
  Scaled y = exp_of((x - n / kParts) * kLn2.high, 0);  // less than half a part: n is 0 there, but for rounding
  const Pair& t = kPowers[static_cast<std::size_t>(whole & (kParts - 1))];
  y.mantissa = multiply(y.mantissa, t);
  y.k += static_cast<int>(whole >> 7);
  return rounded(y);
}

double log(double x) {
  double result = 0;
  int k = 0;
  if (is_special(x, result, k)) return result;
  LogParts parts = log_parts(x, 0);
  if (k != 0) parts.exact += k * 0x1.62e42fefa38p-1, parts.rest += k * 0x1.ef35793c7673p-45;
  return rounded(parts);
}

double log1p(double x) {
  if (std::fabs(x) < kBesideOne) return std::fabs(x) < 0x1p-54 ? x : log_beside_one(x, 0);
  if (!(x > -1)) return x == -1 ? -kInfinite : kNone;
  if (x > 0x1p60) return log(x);
  return log_of_pair(sum_of(1, x));
}

double log2(double x) {
  double result = 0;
  int k = 0;
  if (is_special(x, result, k)) return result;
  const std::uint64_t bits = bits_of(x);
  const bool halved = (bits >> 45 & 127) >= kFirstBelowOne;
  const int exponent = static_cast<int>(bits >> 52) - 1023 + halved + k;
  const Pair part = paired(log_parts(from_bits((bits & 0x000fffffffffffff) | (halved ? 0x3fe0000000000000 : 0x3ff0000000000000)), 0));
  const Pair sum = add({static_cast<double>(exponent), 0}, multiply(part, {0x1.71547652b82fep+0, 0x1.777d0ffda0d24p-56}));
  return sum.high + sum.low;
}

double log10(double x) {
  double result = 0;
  int k = 0;
  if (is_special(x, result, k)) return result;
  Pair value = multiply(paired(log_parts(x, 0)), {0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57});
  if (k != 0) value = add(value, multiply({static_cast<double>(k), 0}, {0x1.34413509f79ffp-2, -0x1.9dc1da994fd21p-59}));
  return value.high + value.low;
}

double pow(double x, double y) {
  if (y == 0 || x == 1) return 1;
  if (x != x || y != y) return x + y;
  const bool whole = std::floor(y) == y, odd = whole && std::fabs(y) < 0x1p53 && std::fmod(y, 2) != 0;
  const double size = std::fabs(x);
  if (size == 0 || size == kInfinite) {
    const double far = (size == 0) == (y > 0) ? 0 : kInfinite;
    return odd && std::signbit(x) ? -far : far;
  }
  if (std::fabs(y) == kInfinite) return size == 1 ? 1 : (size < 1) == (y > 0) ? 0 : kInfinite;
  if (x < 0 && !whole) return kNone;
  if (size == 1) return odd ? x : 1;
  double scaled = size, unused = 0;
  int k = 0;
  (void)is_special(scaled, unused, k);
  Pair log = paired(log_parts(scaled, 0));
  if (k != 0) log = add(log, multiply({static_cast<double>(k), 0}, kLn2));
  if (std::fabs(y) > 0x1p80) return (log.high < 0) == (y > 0) ? 0 : kInfinite;  // |log| ≥ 2^-53
  const double about = y * log.high;
  double power = 0;
  if (about > 1000) power = kInfinite;
  else if (about > -1000) {
    const Pair exponent = std::fabs(about) < 0x1p-60 ? Pair{about, 0} : product_of(y, log.high);
    power = rounded(exp_of(exponent.high, exponent.low + y * log.low));
  }
  return odd && x < 0 ? -power : power;
}

double cbrt(double x) {
  if (x == 0 || !(std::fabs(x) < kInfinite)) return x;
  double size = std::fabs(x), back = 1;
  if (size < 0x1p-900) size *= 0x1p162, back = 0x1p-54;
  if (size > 0x1p900) size *= 0x1p-162, back = 0x1p54;
  double y = from_bits(bits_of(size) / 3 + 0x2a9f7893782da1ceULL);  // a third of the exponent: 4 bits are right
  for (int step = 0; step < 4; ++step) y = y - (y - size / (y * y)) * (1.0 / 3);
  const Pair square = product_of(y, y), cube = product_of(square.high, y);
  const double off = ((cube.high - size) + cube.low) + square.low * y;
  return std::copysign((y - off / (3 * square.high)) * back, x);
}

double sinh(double x) {
  static constexpr double kSeries[] = {0.16666666666666666,    0.008333333333333333,   0.00019841269841269773, 2.7557319224040365e-06,
                                       2.5052108364049466e-08, 1.6059048397722392e-10, 7.646625253572627e-13,  2.8445297426378895e-15};
  const double size = std::fabs(x);
  if (size < 1) return x + x * (x * x) * series(x * x, kSeries);
  if (!(size < 1000)) return x * kInfinite;
  Scaled e = exp_of(size, 0);
  if (size < 22) {
    const double inverse = power_of_two(-2 * e.k) / e.mantissa.high;
    e.mantissa = add(e.mantissa, {-inverse, 0});
    if (e.mantissa.high < 1) e.mantissa = {2 * e.mantissa.high, 2 * e.mantissa.low}, --e.k;
  }
  --e.k;
  return std::copysign(rounded(e), x);
}

double cosh(double x) {
  const double size = std::fabs(x);
  if (!(size < 1000)) return size * kInfinite;
  Scaled e = exp_of(size, 0);
  if (size < 22) {
    e.mantissa = add(e.mantissa, {power_of_two(-2 * e.k) / e.mantissa.high, 0});
    if (e.mantissa.high >= 2) e.mantissa = {0.5 * e.mantissa.high, 0.5 * e.mantissa.low}, ++e.k;
  }
  --e.k;
  return rounded(e);
}

double tanh(double x) {
  static constexpr double kSinh[] = {0.16666666666666666,   0.008333333333333299,   0.00019841269841324225, 2.755731919136874e-06,
                                     2.5052117698709824e-08, 1.605767934982023e-10, 7.746188556142327e-13};
  static constexpr double kCosh[] = {0.5, 0.041666666666666664, 0.0013888888888888978, 2.4801587301371962e-05,
                                     2.755731946995408e-07, 2.087661278332224e-09, 1.1512655495800122e-11};
  const double size = std::fabs(x), y = x * x;
  if (size < 1e-150 || size != size) return x;
  if (size > 22) return std::copysign(1.0, x);
  Pair quotient;
  if (size < 0.5) {
    quotient = divide(fast_sum_of(size, size * y * series(y, kSinh)), fast_sum_of(1, y * series(y, kCosh)));
  } else {
    const Scaled e = exp_of(2 * size, 0);
    const double by = power_of_two(-e.k);  // e ≥ 2.7: nothing cancels badly
    quotient = divide(add(e.mantissa, {-by, 0}), add(e.mantissa, {by, 0}));
  }
  return std::copysign(quotient.high + quotient.low, x);
}

double asinh(double x) {
  static constexpr double kSeries[] = {-0.16666666666666666,  0.0749999999999864,   -0.04464285714025243,  0.030381944248545747,
                                       -0.02237215144990158,  0.017352587714775984, -0.013962235677102962, 0.011526210129238913,
                                       -0.00959145201745799,  0.007622308788669322, -0.004992716071416781, 0.0018854109090885604};
  const double size = std::fabs(x);
  if (size <= 0.5) return x + x * (x * x) * series(x * x, kSeries);
  if (!(size < kInfinite)) return x;
  if (size > 0x1p28) {
    LogParts parts = log_parts(size, 0);
    {
      parts.exact += 0x1.62e42fefa38p-1;
      parts.rest += 0x1.ef35793c7673p-45;
    }
    return std::copysign(rounded(parts), x);
  }
  return std::copysign(log_of_pair(add({size, 0}, root_of_square_and_one(size))), x);
}

double atanh(double x) {
  const double size = std::fabs(x);
  if (!(size < 1)) return size == 1 ? std::copysign(kInfinite, x) : kNone;
  if (size < 0x1p-28) return x;
  const Pair q = divide({2 * size, 0}, sum_of(1, -size));  // (1 + x)/(1 − x) − 1
  if (q.high < kBesideOne) return std::copysign(0.5 * log_beside_one(q.high, q.low), x);
  return std::copysign(0.5 * log_of_pair(add({1, 0}, q)), x);
}

double detail::scaled_hypot(double x, double y) {
  x = std::fabs(x);
  y = std::fabs(y);
  if (x == kInfinite || y == kInfinite) return kInfinite;
  const double most = x > y ? x : y;
  if (most == 0 || x != x || y != y) return x + y;
  const double by = most > 1 ? 0x1p-600 : 0x1p600, u = x * by, v = y * by;
  return std::sqrt(u * u + v * v) / by;
}

}  // namespace orbc::math
