// The fast version of log_map.cpp. The matrix product must be computed in double (in float, cancellation near the eye and near the antipode
// costs 250 and 1000 ulp); the arc length may be computed in float. Highway compiles this file once per instruction set and selects one at
// run time. Kernel: columns and matrix are passed as pointers, one parameter each.
//   H²: r = asinh ρ;   S²: r = atan2(ρ, w) + base;   the image is (x, y)·(r/ρ).
// The polynomials interpolate at Chebyshev nodes; their relative errors are 5e-9 (asinh) and 3e-9 (atan2).
// All instruction sets give the same bits, so that a file does not depend on the machine that compiled the scene: only operations that
// IEEE 754 rounds correctly are used, in one order, none of them fused. Compared with a fused kernel this costs 3 % in S² and nothing in
// E²; the shorter polynomials gain 30 % in H² (measured with AVX-512).
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
#include "compiler/bend/log_map_plain.h"

#ifndef __EMSCRIPTEN__
HWY_BEFORE_NAMESPACE();
namespace orbc::bend {
namespace HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR
// The fallback for machines below SSSE3.
void BendVectors(int curvature, const double* matrix, float base, const double* w, const double* x, const double* y, const float* z,
                 std::size_t count, float* out) {
  for (std::size_t i = 0; i < count; ++i) bend_one(curvature, matrix, base, w[i], x[i], y[i], z[i], out + 3 * i);
}
#else
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using DoubleTag = hn::Repartition<double, FloatTag>;
using Float = hn::Vec<FloatTag>;
using Double = hn::Vec<DoubleTag>;

template <class V>
HWY_INLINE V mul_add(V a, V b, V c) { return hn::Add(hn::Mul(a, b), c); }
template <class V>
HWY_INLINE V neg_mul_add(V a, V b, V c) { return hn::Sub(c, hn::Mul(a, b)); }

HWY_INLINE Float constant(float v) { return hn::Set(FloatTag(), v); }

template <std::size_t N>
HWY_INLINE Float polynomial(Float x, const float (&c)[N]) {
  Float sum = constant(c[N - 1]);
  for (std::size_t i = N - 1; i-- > 0;) sum = mul_add(sum, x, constant(c[i]));
  return sum;
}

/// asinh ρ = log(ρ + w) for ρ ≥ 0, w = √(1+ρ²): with ρ + w = 2^k m and s = (m − 1)/(m + 1), k ln 2 + 2 atanh s. Up to ρ + w = √8 with
/// k = 0 and s = ρ/(1 + w), which loses nothing: there the rounding of ρ + w would be 3 ulp of the result.
HWY_INLINE Float asinh_of(Float rho, Float w) {
  static constexpr float kSeries[] = {0.666666627f, 0.400005579f, 0.285432875f, 0.2273283f, 0.141076148f, 0.29407531f};  // 2/3 + 2/5 y + …
  const FloatTag df;
  const hn::RebindToSigned<FloatTag> di;
  // Bits of √½: subtracting them makes the exponent field count from [√½, √2).
  const auto e = hn::Add(rho, w);
  const auto direct = hn::Lt(e, constant(2.82842712f));
  const auto bits = hn::Sub(hn::BitCast(di, e), hn::Set(di, 0x3f3504f3));
  const auto k = hn::IfThenZeroElse(direct, hn::ConvertTo(df, hn::ShiftRight<23>(bits)));
  const auto m = hn::BitCast(df, hn::Add(hn::And(bits, hn::Set(di, 0x007fffff)), hn::Set(di, 0x3f3504f3)));
  const auto s = hn::Div(hn::IfThenElse(direct, rho, hn::Sub(m, constant(1))), hn::Add(hn::IfThenElse(direct, w, m), constant(1)));
  const auto y = hn::Mul(s, s);
  // ln 2 = high + low; the high part times k is exact.
  const auto small = mul_add(hn::Mul(s, y), polynomial(y, kSeries), hn::Mul(k, constant(-2.12194440e-4f)));
  return mul_add(k, constant(0.693359375f), hn::Add(hn::Add(s, s), small));
}

/// atan2(ρ, w) for ρ ≥ 0, in [0, π].
HWY_INLINE Float atan2_of(Float rho, Float w) {
  static constexpr float kAtan[] = {-0.333333313f, 0.199995399f, -0.142639503f, 0.107436687f, -0.0645171851f};
  const auto aw = hn::Abs(w), small = hn::Min(rho, aw), big = hn::Max(rho, aw);
  // Beyond π/8 the angle is counted from π/4: |t| ≤ tan(π/8).
  const auto beyond = hn::Gt(small, hn::Mul(big, constant(0.414213562f)));
  const auto t = hn::Div(hn::IfThenElse(beyond, hn::Sub(small, big), small), hn::IfThenElse(beyond, hn::Add(small, big), big));
  const auto t2 = hn::Mul(t, t);
  auto angle = mul_add(hn::Mul(t, t2), polynomial(t2, kAtan), t);
  angle = hn::Add(angle, hn::IfThenElseZero(beyond, constant(0.785398163f)));
  // π/2 − a and π − a with the constants in two pieces.
  angle = hn::IfThenElse(hn::Gt(rho, aw), hn::Add(hn::Sub(constant(1.57079637f), angle), constant(-4.37113883e-8f)), angle);
  return hn::IfThenElse(hn::Lt(w, hn::Zero(FloatTag())), hn::Add(hn::Sub(constant(3.14159274f), angle), constant(-8.74227766e-8f)), angle);
}

struct Rows {
  Double m[9];
};

/// One row of the matrix times as many points as a float vector holds.
HWY_INLINE Float row(const Double* m, Double w0, Double x0, Double y0, Double w1, Double x1, Double y1) {
  const FloatTag df;
  const hn::Half<FloatTag> dh;
  const auto low = mul_add(m[0], w0, mul_add(m[1], x0, hn::Mul(m[2], y0)));
  const auto high = mul_add(m[0], w1, mul_add(m[1], x1, hn::Mul(m[2], y1)));
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
  const auto rho2 = mul_add(x, x, hn::Mul(y, y));
  const auto rho = hn::Sqrt(rho2);
  // Closer than 1e-15 to the axis the factor is 1, its limit on sheet 0. On other sheets there are no vertices so close (tessellate.h).
  const auto tiny = hn::Lt(rho2, constant(1e-30f));
  Float r;
  if constexpr (kCurvature < 0) {
    r = asinh_of(rho, hn::Sqrt(hn::Add(constant(1), rho2)));
  } else {
    const auto w = row(rows.m, w0, x0, y0, w1, x1, y1);
    r = hn::Add(constant(base), atan2_of(rho, w));
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
  // The remaining points go through the same code in a padded block, so that the bits of a vertex do not depend on its index.
  constexpr std::size_t kMaxLanes = HWY_MAX_BYTES / sizeof(float);
  double tw[kMaxLanes], tx[kMaxLanes] = {}, ty[kMaxLanes] = {};
  float tz[kMaxLanes] = {}, bent[3 * kMaxLanes];
  std::fill(tw, tw + kMaxLanes, 1.0);
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

#if defined(__EMSCRIPTEN__) || HWY_ONCE
namespace orbc::bend {
#ifdef __EMSCRIPTEN__
static void bend_vectors(int curvature, const double* matrix, float base, const double* w, const double* x, const double* y, const float* z,
                         std::size_t count, float* out) {
  for (std::size_t i = 0; i < count; ++i) bend_one(curvature, matrix, base, w[i], x[i], y[i], z[i], out + 3 * i);
}
#else
HWY_EXPORT(BendVectors);
#define bend_vectors HWY_DYNAMIC_DISPATCH(BendVectors)
#endif

void bend_points(const LogMap& map, const PointColumns& points, std::size_t first, std::size_t count, float* out) {
  double matrix[9], largest = 0;
  for (int i = 0; i < 9; ++i) {
    matrix[i] = map.eye_from_copy[i / 3][i % 3];
    largest = std::max(largest, std::abs(matrix[i]));
  }
  // ρ² must stay below 3e38 in float, so points beyond 30 curvature radii are computed without vectors. Rooms have w < 1e4.
  if (map.space == geometry::Space::hyperbolic && largest > 1e13) return bend_points_scalar(map, points, first, count, out);
  const bool far_side = map.sheet % 2 == 1;
  const float base = static_cast<float>(far_side ? -(map.sheet + 1) * std::numbers::pi : map.sheet * std::numbers::pi);
  bend_vectors(geometry::curvature(map.space), matrix, base, points.w.data() + first, points.x.data() + first, points.y.data() + first,
               points.z.data() + first, count, out);
}
}  // namespace orbc::bend
#endif
