// For polygons Steinberg's formula reads, with [k] = 1 + t + … + t^(k−1),
//   1/W(t) = D(t)/(1 + t),   D(t) = 1 + t − N·t + Σ t^kᵢ/[kᵢ]   (walls give 1/(1+t), corners 1/((1+t)[k]), nothing else is finite).
// Over the common denominator L = lcm [kᵢ] = Π Φ_d (d > 1 dividing a kᵢ) both sides are polynomials. Products of cyclotomic polynomials are
// products and quotients of factors 1 − tᵉ; as power series modulo a power of t each factor costs one pass of additions.
#include "compiler/notation/growth.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "compiler/base/check.h"
#include "compiler/notation/classify.h"
#include "compiler/notation/euler.h"

namespace orbc::notation {
namespace {

using geometry::Space;
using Series = std::vector<Integer>;  // coefficients, low order first

Space space_of(const Orbifold& orbifold) {
  ORBC_CHECK(is_orbifold(orbifold), ==, true);
  return classify(orbifold).value();
}

std::vector<int> orders_of(const Orbifold& orbifold) {
  std::vector<int> orders;
  for (const Rational& corner : orbifold.corners) orders.push_back(static_cast<int>(numerator(corner)));
  return orders;
}

std::vector<int> prime_divisors(int n) {
  std::vector<int> primes;
  for (int p = 2; p * p <= n; ++p) {
    if (n % p != 0) continue;
    primes.push_back(p);
    while (n % p == 0) n /= p;
  }
  if (n > 1) primes.push_back(n);
  return primes;
}

std::vector<int> divisors(int n) {
  std::vector<int> all;
  for (int d = 1; d * d <= n; ++d) {
    if (n % d != 0) continue;
    all.push_back(d);
    if (d != n / d) all.push_back(n / d);
  }
  return all;
}

int totient(int n) {
  int count = n;
  for (const int p : prime_divisors(n)) count -= count / p;
  return count;
}

void multiply_by_one_minus(Series& series, int e) {
  for (std::size_t i = series.size(), step = static_cast<std::size_t>(e); i-- > step;) series[i] -= series[i - step];
}

void divide_by_one_minus(Series& series, int e) {
  for (std::size_t step = static_cast<std::size_t>(e), i = step; i < series.size(); ++i) series[i] += series[i - step];
}

// Φ_d = Π (1 − t^(d/q))^μ(q) over the square-free divisors q of d (d > 1): exponents of 1 − tᵉ.
std::map<int, int> cyclotomic_exponents(int d) {
  std::map<int, int> exponents{{d, 1}};
  for (const int p : prime_divisors(d)) {
    std::map<int, int> next = exponents;
    for (const auto& [e, c] : exponents) next[e / p] -= c;
    exponents = std::move(next);
  }
  return exponents;
}

void multiply(Series& series, const std::map<int, int>& exponents, int sign) {
  for (const auto& [e, c] : exponents) {
    for (int i = 0; i < sign * c; ++i) multiply_by_one_minus(series, e);
    for (int i = 0; i < -sign * c; ++i) divide_by_one_minus(series, e);
  }
}

// Φ_d divides a polynomial p exactly when p·Π(1 − t^(d/q)) over the primes q of d vanishes modulo 1 − t^d, because the product is zero at
// all d-th roots of unity except the primitive ones.
bool is_divisible(const Series& polynomial, int d) {
  const std::size_t order = static_cast<std::size_t>(d);
  Series rest(order);
  for (std::size_t i = 0; i < polynomial.size(); ++i) rest[i % order] += polynomial[i];
  for (const int p : prime_divisors(d)) {
    const std::size_t shift = order / static_cast<std::size_t>(p);
    Series next = rest;
    for (std::size_t i = 0; i < order; ++i) next[(i + shift) % order] -= rest[i];
    rest = std::move(next);
  }
  return std::all_of(rest.begin(), rest.end(), [](const Integer& c) { return c == 0; });
}

void trim(Series& series) {
  while (series.size() > 1 && series.back() == 0) series.pop_back();
}

// Finite groups: W = Π [d] over the degrees d of the basic invariants.
std::vector<int> degrees(const std::vector<int>& orders) {
  if (orders.empty()) return {2};
  if (orders.size() == 2) return {2, orders[0]};
  std::vector<int> sorted = orders;
  std::sort(sorted.begin(), sorted.end());
  if (sorted[1] == 2) return {2, 2, sorted[2]};
  return sorted[2] == 3 ? std::vector<int>{2, 3, 4} : sorted[2] == 4 ? std::vector<int>{2, 4, 6} : std::vector<int>{2, 6, 10};
}

// The first `size` coefficients of Π [d].
Series finite_series(const std::vector<int>& orders, std::size_t size) {
  Series series(size);
  series[0] = 1;
  for (const int d : degrees(orders)) multiply_by_one_minus(series, d), divide_by_one_minus(series, 1);
  return series;
}

// D(t) up to t^(size−1), as a power series: t^k/[k] = Σ (t^(jk) − t^(jk+1)).
std::vector<std::int64_t> steinberg_series(const std::vector<int>& orders, std::size_t size) {
  std::vector<std::int64_t> d(size);
  d[0] = 1;
  if (size > 1) d[1] = 1 - static_cast<std::int64_t>(orders.size());
  for (const int k : orders)
    for (std::size_t i = static_cast<std::size_t>(k); i < size; i += static_cast<std::size_t>(k)) {
      d[i] += 1;
      if (i + 1 < size) d[i + 1] -= 1;
    }
  return d;
}

}  // namespace

std::optional<int> longest_length(const Orbifold& orbifold) {
  if (space_of(orbifold) != Space::spherical) return std::nullopt;
  int length = 0;
  for (const int d : degrees(orders_of(orbifold))) length += d - 1;
  return length;
}

std::optional<Integer> group_order(const Orbifold& orbifold) {
  if (space_of(orbifold) != Space::spherical) return std::nullopt;
  return numerator(Rational(2 / euler_characteristic(orbifold)));
}

std::optional<GrowthSeries> growth_series(const Orbifold& orbifold, int max_degree) {
  // Two parallel mirrors make (1 + t)/(1 − t); a mirror at right angles to both gives a factor 1 + t.
  if (orbifold.strip) return is_half_strip(orbifold) ? GrowthSeries{{1, 2, 1}, {1, -1}} : GrowthSeries{{1, 1}, {1, -1}};
  const std::vector<int> orders = orders_of(orbifold);
  if (space_of(orbifold) == Space::spherical) {
    const int length = *longest_length(orbifold);
    if (length > max_degree) return std::nullopt;
    return GrowthSeries{finite_series(orders, static_cast<std::size_t>(length) + 1), {1}};
  }

  std::set<int> factors;  // the d of L = Π Φ_d
  std::map<int, int> counts;
  for (const int k : orders) {
    if (k > max_degree) return std::nullopt;
    ++counts[k];
    for (const int d : divisors(k))
      if (d > 1) factors.insert(d);
  }
  int degree = 0;
  for (const int d : factors)
    if ((degree += totient(d)) > max_degree) return std::nullopt;

  Series common(static_cast<std::size_t>(degree) + 2);  // one more than the degree of L, which is that of numerator and denominator
  common[0] = 1;
  for (const int d : factors) multiply(common, cyclotomic_exponents(d), +1);

  GrowthSeries series;
  series.numerator = common;
  multiply(series.numerator, cyclotomic_exponents(2), +1);
  series.denominator = common;
  const Integer walls = orders.size();
  for (std::size_t i = common.size(); i-- > 1;) series.denominator[i] += (1 - walls) * common[i - 1];
  for (const auto& [k, count] : counts) {
    Series corner = common;
    multiply_by_one_minus(corner, 1);
    divide_by_one_minus(corner, k);
    for (std::size_t i = static_cast<std::size_t>(k); i < common.size(); ++i)
      series.denominator[i] += count * corner[i - static_cast<std::size_t>(k)];
  }

  std::vector<int> common_factors(factors.begin(), factors.end());
  common_factors.push_back(2);  // from 1 + t
  for (const int d : common_factors) {
    if (!is_divisible(series.denominator, d)) continue;
    multiply(series.denominator, cyclotomic_exponents(d), -1);
    multiply(series.numerator, cyclotomic_exponents(d), -1);
  }
  trim(series.numerator);
  trim(series.denominator);
  return series;
}

std::vector<Integer> copies_per_length(const Orbifold& orbifold, int max_length) {
  ORBC_CHECK(max_length, >=, 0);
  const Space space = space_of(orbifold);
  const std::vector<int> orders = orders_of(orbifold);
  if (space == Space::spherical)
    return finite_series(orders, static_cast<std::size_t>(std::min(max_length, *longest_length(orbifold))) + 1);
  // W·D = N. Long lists take D and N of the rational function, if it is short; others Steinberg's series and 1 + t.
  const std::size_t size = static_cast<std::size_t>(max_length) + 1;
  GrowthSeries quotient{{1, 1}, {}};
  if (std::optional<GrowthSeries> series = growth_series(orbifold, std::min(max_length / 2, 1000))) {
    quotient = *std::move(series);
  } else {
    for (const std::int64_t d : steinberg_series(orders, size)) quotient.denominator.emplace_back(d);
  }
  std::vector<Integer> copies(size);
  for (std::size_t n = 0; n < size; ++n) {
    Integer count = n < quotient.numerator.size() ? quotient.numerator[n] : Integer(0);
    for (std::size_t j = 1; j <= n && j < quotient.denominator.size(); ++j)
      if (quotient.denominator[j] != 0) count -= quotient.denominator[j] * copies[n - j];
    copies[n] = std::move(count);
  }
  return copies;
}

Integer copies_up_to(const Orbifold& orbifold, int length) {
  const std::vector<Integer> copies = copies_per_length(orbifold, length);
  return std::accumulate(copies.begin(), copies.end(), Integer(0));
}

/// By squaring: the bits of the C library's function depend on the machine.
static long double power_of(long double t, int k) {
  long double power = 1;
  for (; k > 0; k /= 2, t *= t)
    if (k % 2 == 1) power *= t;
  return power;
}

std::optional<double> growth_rate(const Orbifold& orbifold) {
  const Space space = space_of(orbifold);
  if (space == Space::spherical) return std::nullopt;
  if (space == Space::euclidean) return 1;
  // D falls from 1 at 0 through one zero in (0, 1): the reciprocal roots are a Salem number, its inverse and points of the unit circle
  // (Parry, Growth series of Coxeter groups and Salem numbers, 1993). No polygon group grows more slowly than *237, so the zero lies below
  // 0.86. With extended precision, the rounding to double is the only visible error.
  std::map<int, int> counts;
  for (const int k : orders_of(orbifold)) ++counts[k];
  const long double walls = static_cast<long double>(orbifold.corners.size());
  const auto value = [&](long double t) {
    long double sum = 1 + t - walls * t;
    for (const auto& [k, count] : counts) {
      const long double power = power_of(t, k);
      sum += static_cast<long double>(count) * power * (1 - t) / (1 - power);
    }
    return sum;
  };
  long double low = 0, high = 0.86L;
  for (int i = 0; i < 120; ++i) {
    const long double middle = (low + high) / 2;
    if (middle <= low || middle >= high) break;
    (value(middle) > 0 ? low : high) = middle;
  }
  return static_cast<double>(2 / (low + high));
}

}  // namespace orbc::notation
