// The fast twin of log_map.cpp. Idea and measured alternatives: the matrix product must be double (in float, cancellation near the eye and
// near the antipode costs 250 and 1000 ulp), the arc length may be float. Highway compiles this file once per instruction set and picks one
// at run time.
//   H²: r = asinh ρ = log1p(ρ + ρ²/(1 + √(1+ρ²)));   S²: r = atan2(ρ, w);   the image is (x, y)·(reach/ρ).
// Polynomials: interpolation at Chebyshev nodes; relative errors of log1p and atan 3e-9 and 2.5e-8.
#ifndef __EMSCRIPTEN__
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compiler/bend/log_map_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#endif

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/bend/log_map.h"

#ifndef __EMSCRIPTEN__
HWY_BEFORE_NAMESPACE();
namespace orbc::bend {
namespace HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR
// The fallback for machines below SSSE3: the scalar twin's formula.
void BendVectors(int curvature, const double* m, float base, const double* w, const double* x, const double* y, const float* z,
                 std::size_t count, float* out) {
  for (std::size_t i = 0; i < count; ++i, out += 3) {
    const double u = m[3] * w[i] + m[4] * x[i] + m[5] * y[i], v = m[6] * w[i] + m[7] * x[i] + m[8] * y[i], rho = std::hypot(u, v);
    const double r = curvature == 0  ? rho
                     : curvature < 0 ? std::asinh(rho)
                                     : base + std::atan2(rho, m[0] * w[i] + m[1] * x[i] + m[2] * y[i]);
    const double factor = rho < 1e-15 ? 1 : r / rho;
    out[0] = static_cast<float>(u * factor);
    out[1] = static_cast<float>(v * factor);
    out[2] = z[i];
  }
}
#else
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using DoubleTag = hn::Repartition<double, FloatTag>;
using Float = hn::Vec<FloatTag>;
using Double = hn::Vec<DoubleTag>;

HWY_INLINE Float constant(float v) { return hn::Set(FloatTag(), v); }

template <std::size_t N>
HWY_INLINE Float polynomial(Float x, const float (&c)[N]) {
  Float sum = constant(c[N - 1]);
  for (std::size_t i = N - 1; i-- > 0;) sum = hn::MulAdd(sum, x, constant(c[i]));
  return sum;
}

/// log(1 + u) for u ≥ 0: 1 + u = 2^k (1 + f) with |f| < 0.42, what 1 + u has rounded off is given back to f.
HWY_INLINE Float log1p_of(Float u) {
  static constexpr float kLog[] = {0.333333313f,  -0.24999997f, 0.200007156f,  -0.166678026f, 0.142490581f,
                                   -0.124256872f, 0.116854198f, -0.114797339f, 0.0697161108f};
  const FloatTag df;
  const hn::RebindToSigned<FloatTag> di;
  const auto y = hn::Add(constant(1), u);
  // Bits of √½: subtracting them makes the exponent field count from [√½, √2).
  const auto bits = hn::Sub(hn::BitCast(di, y), hn::Set(di, 0x3f3504f3));
  const auto k = hn::ShiftRight<23>(bits);
  const auto mantissa = hn::BitCast(df, hn::Add(hn::And(bits, hn::Set(di, 0x007fffff)), hn::Set(di, 0x3f3504f3)));
  const auto scale = hn::BitCast(df, hn::ShiftLeft<23>(hn::Sub(hn::Set(di, 127), k)));  // 2^−k
  const auto lost = hn::IfThenElse(hn::Lt(u, constant(1)), hn::Sub(u, hn::Sub(y, constant(1))), hn::Sub(constant(1), hn::Sub(y, u)));
  const auto f = hn::MulAdd(lost, scale, hn::Sub(mantissa, constant(1)));
  const auto f2 = hn::Mul(f, f);
  const auto kf = hn::ConvertTo(df, k);
  // ln 2 = high + low; the high part times k is exact.
  auto tail = hn::Mul(hn::Mul(f, f2), polynomial(f, kLog));
  tail = hn::MulAdd(kf, constant(-2.12194440e-4f), tail);
  tail = hn::NegMulAdd(constant(0.5f), f2, tail);
  return hn::MulAdd(kf, constant(0.693359375f), hn::Add(f, tail));
}

/// atan2(ρ, w) for ρ ≥ 0, in [0, π].
HWY_INLINE Float atan2_of(Float rho, Float w) {
  static constexpr float kAtan[] = {-0.333333313f, 0.199997395f,   -0.142785683f, 0.110337645f,   -0.0865688026f,
                                    0.0625016913f, -0.0358715393f, 0.0135077713f, -0.00238699722f};
  const auto aw = hn::Abs(w);
  const auto steep = hn::Gt(rho, aw);
  const auto t = hn::Div(hn::Min(rho, aw), hn::Max(rho, aw));
  const auto t2 = hn::Mul(t, t);
  auto angle = hn::MulAdd(hn::Mul(t, t2), polynomial(t2, kAtan), t);
  // π/2 − a and π − a with the constants in two pieces.
  angle = hn::IfThenElse(steep, hn::Add(hn::Sub(constant(1.57079637f), angle), constant(-4.37113883e-8f)), angle);
  return hn::IfThenElse(hn::Lt(w, hn::Zero(FloatTag())), hn::Add(hn::Sub(constant(3.14159274f), angle), constant(-8.74227766e-8f)), angle);
}

struct Rows {
  Double m[9];
};

/// One row of the matrix times as many points as a float vector holds.
HWY_INLINE Float row(const Double* m, Double w0, Double x0, Double y0, Double w1, Double x1, Double y1) {
  const FloatTag df;
  const hn::Half<FloatTag> dh;
  const auto low = hn::MulAdd(m[0], w0, hn::MulAdd(m[1], x0, hn::Mul(m[2], y0)));
  const auto high = hn::MulAdd(m[0], w1, hn::MulAdd(m[1], x1, hn::Mul(m[2], y1)));
  return hn::Combine(df, hn::DemoteTo(dh, high), hn::DemoteTo(dh, low));
}

template <int kCurvature>
HWY_INLINE void bend_block(const Rows& rows, float base, const double* pw, const double* px, const double* py, const float* pz,
                           float* out) {
  const FloatTag df;
  const DoubleTag dd;
  const std::size_t half = hn::Lanes(dd);
  const auto w0 = hn::LoadU(dd, pw), x0 = hn::LoadU(dd, px), y0 = hn::LoadU(dd, py);
  const auto w1 = hn::LoadU(dd, pw + half), x1 = hn::LoadU(dd, px + half), y1 = hn::LoadU(dd, py + half);
  const auto x = row(rows.m + 3, w0, x0, y0, w1, x1, y1), y = row(rows.m + 6, w0, x0, y0, w1, x1, y1);
  const auto z = hn::LoadU(df, pz);
  if constexpr (kCurvature == 0) {
    hn::StoreInterleaved3(x, y, z, df, out);
    return;
  }
  const auto rho2 = hn::MulAdd(x, x, hn::Mul(y, y));
  const auto rho = hn::Sqrt(rho2);
  // Closer than 1e-15 to the axis the factor is its limit on sheet 0 (1); what has no image there is nobody's vertex.
  const auto tiny = hn::Lt(rho2, constant(1e-30f));
  Float r;
  if constexpr (kCurvature < 0) {
    const auto w = hn::Sqrt(hn::Add(constant(1), rho2));
    r = log1p_of(hn::Add(rho, hn::Div(rho2, hn::Add(constant(1), w))));
  } else {
    const auto w = row(rows.m, w0, x0, y0, w1, x1, y1);
    r = hn::Add(constant(base), atan2_of(rho, w));  // base: where sheet `sheet` begins; negative where the image is opposite
  }
  const auto factor = hn::IfThenElse(tiny, constant(1), hn::Div(r, rho));
  hn::StoreInterleaved3(hn::Mul(x, factor), hn::Mul(y, factor), z, df, out);
}

template <int kCurvature>
void bend_all(const double* matrix, float base, const double* w, const double* x, const double* y, const float* z, std::size_t count,
              float* out) {
  const DoubleTag dd;
  const std::size_t lanes = hn::Lanes(FloatTag());
  Rows rows;
  for (int i = 0; i < 9; ++i) rows.m[i] = hn::Set(dd, matrix[i]);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) bend_block<kCurvature>(rows, base, w + i, x + i, y + i, z + i, out + 3 * i);
  if (i == count) return;
  // The rest goes through the same code on a padded block, so that a vertex has the same bits wherever it stands.
  constexpr std::size_t kMost = HWY_MAX_BYTES / sizeof(float);
  double tw[kMost], tx[kMost] = {}, ty[kMost] = {};
  float tz[kMost] = {}, bent[3 * kMost];
  std::fill(tw, tw + kMost, 1.0);
  const std::size_t rest = count - i;
  std::copy_n(w + i, rest, tw);
  std::copy_n(x + i, rest, tx);
  std::copy_n(y + i, rest, ty);
  std::copy_n(z + i, rest, tz);
  bend_block<kCurvature>(rows, base, tw, tx, ty, tz, bent);
  std::copy_n(bent, 3 * rest, out + 3 * i);
}

void BendVectors(int curvature, const double* matrix, float base, const double* w, const double* x, const double* y, const float* z,
                 std::size_t count, float* out) {
  if (curvature < 0) return bend_all<-1>(matrix, base, w, x, y, z, count, out);
  if (curvature > 0) return bend_all<1>(matrix, base, w, x, y, z, count, out);
  bend_all<0>(matrix, base, w, x, y, z, count, out);
}
#endif  // HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace orbc::bend
HWY_AFTER_NAMESPACE();
#endif  // __EMSCRIPTEN__

#if defined(__EMSCRIPTEN__)
namespace orbc::bend {
void bend_points(const LogMap& map, const PointColumns& points, std::size_t first, std::size_t count, float* out) {
  bend_points_scalar(map, points, first, count, out);
}
}  // namespace orbc::bend
#elif HWY_ONCE
namespace orbc::bend {
HWY_EXPORT(BendVectors);

void bend_points(const LogMap& map, const PointColumns& points, std::size_t first, std::size_t count, float* out) {
  double matrix[9], largest = 0;
  for (int i = 0; i < 9; ++i) {
    matrix[i] = map.eye_from_copy[i / 3][i % 3];
    largest = std::max(largest, std::abs(matrix[i]));
  }
  // ρ² must stay below 3e38 in float; what lies farther than 30 curvature radii goes the slow way. Rooms reach w < 1e4.
  if (map.space == geometry::Space::hyperbolic && largest > 1e13) return bend_points_scalar(map, points, first, count, out);
  const bool far_side = map.sheet % 2 == 1;
  const float base = static_cast<float>(far_side ? -(map.sheet + 1) * std::numbers::pi : map.sheet * std::numbers::pi);
  HWY_DYNAMIC_DISPATCH(BendVectors)
  (geometry::curvature(map.space), matrix, base, points.w.data() + first, points.x.data() + first, points.y.data() + first,
   points.z.data() + first, count, out);
}
}  // namespace orbc::bend
#endif
