#pragma once
// Elementary functions whose bits depend on their arguments only. Those of the C library depend on the processor (glibc chooses a variant
// with or without fused multiply-add) and on the version of the library, so the same scene would give different files. These functions use
// only operations that IEEE 754 rounds correctly, in one order. All rooms call these and never the library's (scripts/check).
//
// Error: below 1 ulp of the result, for all arguments unless said otherwise (measured: tan 0.97, others below 0.8;
// tests/unit/base/elementary_test.cpp). Special values are those of C's Annex F; errno and floating-point flags are not promised.
#include <cmath>
#include <complex>

namespace orbc::math {

/// The error bound holds for |x| < 2^20. Larger arguments are reduced by the double nearest to 2π, which is deterministic but not accurate.
[[nodiscard]] double sin(double x);
[[nodiscard]] double cos(double x);
[[nodiscard]] double tan(double x);
struct SineCosine {
  double sine, cosine;
};
/// Both at once, with the same bits as `sin` and `cos`.
[[nodiscard]] SineCosine sin_cos(double x);

[[nodiscard]] double asin(double x);
[[nodiscard]] double acos(double x);
[[nodiscard]] double atan(double x);
[[nodiscard]] double atan2(double y, double x);

[[nodiscard]] double exp(double x);
[[nodiscard]] double exp2(double x);
[[nodiscard]] double log(double x);
[[nodiscard]] double log1p(double x);
[[nodiscard]] double log2(double x);
[[nodiscard]] double log10(double x);
[[nodiscard]] double pow(double x, double y);
[[nodiscard]] double cbrt(double x);

[[nodiscard]] double sinh(double x);
[[nodiscard]] double cosh(double x);
[[nodiscard]] double tanh(double x);
[[nodiscard]] double asinh(double x);
[[nodiscard]] double atanh(double x);

namespace detail {
[[nodiscard]] double scaled_hypot(double x, double y);
}

/// √(x² + y²); below 1.25 ulp.
[[nodiscard]] inline double hypot(double x, double y) {
  const double square = x * x + y * y;
  if (square > 1e-280 && square < 1e300) return std::sqrt(square);
  return detail::scaled_hypot(x, y);
}
[[nodiscard]] inline double abs(const std::complex<double>& z) { return hypot(z.real(), z.imag()); }
[[nodiscard]] inline std::complex<double> polar(double r, double angle) {
  const SineCosine at = sin_cos(angle);
  return {r * at.cosine, r * at.sine};
}

}  // namespace orbc::math
