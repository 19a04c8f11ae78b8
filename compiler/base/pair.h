#pragma once
// Numbers of twice the precision of double, as unevaluated sums: Dekker, A floating-point technique for extending the available precision,
// 1971; Knuth, TAOCP 2, §4.2.2. Without fused multiply-add, so that every processor gives the same bits.

namespace orbc {

/// high + low, |low| at most half an ulp of high.
struct Pair {
  double high = 0, low = 0;
};

/// a + b exactly.
[[nodiscard]] constexpr Pair sum_of(double a, double b) {
  const double s = a + b, t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}
/// The same for |a| ≥ |b|, or a = 0.
[[nodiscard]] constexpr Pair fast_sum_of(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}
/// a · b exactly. In: no overflow: |a|, |b| < 2^970; no underflow: |a·b| > 2^-960 or 0.
[[nodiscard]] constexpr Pair product_of(double a, double b) {
  constexpr double kSplit = 134217729;  // 2^27 + 1
  const double ca = kSplit * a, ah = ca - (ca - a), al = a - ah;
  const double cb = kSplit * b, bh = cb - (cb - b), bl = b - bh;
  const double p = a * b;
  return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

// Relative error: about 2^-102.
[[nodiscard]] constexpr Pair add(const Pair& a, const Pair& b) {
  const Pair s = sum_of(a.high, b.high);
  return fast_sum_of(s.high, s.low + (a.low + b.low));
}
[[nodiscard]] constexpr Pair multiply(const Pair& a, const Pair& b) {
  const Pair p = product_of(a.high, b.high);
  return fast_sum_of(p.high, p.low + (a.high * b.low + a.low * b.high));
}
[[nodiscard]] constexpr Pair divide(const Pair& a, const Pair& b) {
  const double q = a.high / b.high;
  const Pair p = product_of(q, b.high);
  return fast_sum_of(q, (((a.high - p.high) - p.low) + (a.low - q * b.low)) / b.high);
}

}  // namespace orbc
