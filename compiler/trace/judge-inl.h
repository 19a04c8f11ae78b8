// The node test and the leaf test, eight boxes or triangles at a time. Included once per instruction set (Highway's way), hence the guard.
#if defined(ORBC_TRACE_JUDGE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ORBC_TRACE_JUDGE_INL_H
#undef ORBC_TRACE_JUDGE_INL_H
#else
#define ORBC_TRACE_JUDGE_INL_H
#endif

#include <hwy/highway.h>

#include <cmath>

#include "compiler/trace/chart_ray.h"
#include "compiler/trace/unfused-inl.h"

HWY_BEFORE_NAMESPACE();
namespace orbc::trace::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using geometry::Space;
using D = hn::CappedTag<float, 8>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

/// Odd polynomial, increasing on all of ℝ: no clamp is needed however far a box lies.
template <int kTerms>
HWY_INLINE V odd_polynomial(const Chart& chart, V a, V shift) {
  const D d;
  if constexpr (kTerms == 1) return hn::Add(a, shift);
  const auto c = [&](int k) { return hn::Set(d, chart.poly[k]); };
  const V y = hn::Mul(a, a);  // Estrin's order: the chain of dependent steps is what a node waits for
  if constexpr (kTerms == 2) return hn::MulAdd(a, hn::MulAdd(y, c(1), c(0)), shift);
  const V yy = hn::Mul(y, y), low = hn::MulAdd(y, c(1), c(0));
  if constexpr (kTerms == 3) return hn::MulAdd(a, hn::MulAdd(yy, c(2), low), shift);
  const V high = hn::MulAdd(y, c(3), c(2));
  if constexpr (kTerms == 4) return hn::MulAdd(a, hn::MulAdd(yy, high, low), shift);
  if constexpr (kTerms == 5) return hn::MulAdd(a, hn::MulAdd(yy, hn::MulAdd(yy, c(4), high), low), shift);
  const V top = hn::MulAdd(yy, c(6), hn::MulAdd(y, c(5), c(4)));
  return hn::MulAdd(a, hn::MulAdd(yy, hn::MulAdd(yy, top, high), low), shift);
}

HWY_INLINE int lowest_bit(std::uint32_t bits) { return static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits)); }

/// Which of a node's boxes the ray may touch between `start` and `end`, and where it enters them.
template <int kTerms>
HWY_INLINE std::uint32_t touched(const Node8& node, const Chart& chart, const ChartRay& ray, float end, float* HWY_RESTRICT enters) {
  const D d;
  std::uint32_t bits = 0;
  const V error = hn::Set(d, chart.poly_error), minus_error = hn::Set(d, -chart.poly_error);
  for (std::size_t i = 0; i < 8; i += hn::Lanes(d)) {
    V near = hn::Set(d, ray.start), far = hn::Set(d, end);
    for (int a = 0; a < 2; ++a) {
      const V scale = hn::Set(d, ray.scale[a]);
      near = hn::Max(near, hn::MulSub(hn::Load(d, node.bounds[a][ray.near[a]] + i), scale, hn::Set(d, ray.near_offset[a])));
      far = hn::Min(far, hn::MulSub(hn::Load(d, node.bounds[a][1 - ray.near[a]] + i), scale, hn::Set(d, ray.far_offset[a])));
    }
    const V slope = hn::Set(d, ray.slope);
    const V low = hn::MulSub(hn::Load(d, node.bounds[2][ray.near[2]] + i), slope, hn::Set(d, ray.near_height));
    const V high = hn::MulSub(hn::Load(d, node.bounds[2][1 - ray.near[2]] + i), slope, hn::Set(d, ray.far_height));
    near = hn::Max(near, odd_polynomial<kTerms>(chart, low, minus_error));
    far = hn::Min(far, odd_polynomial<kTerms>(chart, high, error));
    hn::Store(near, d, enters + i);
    std::uint8_t mask[8] = {};
    hn::StoreMaskBits(d, hn::Le(near, far), mask);
    bits |= static_cast<std::uint32_t>(mask[0]) << i;
  }
  return bits;
}

/// A corner of eight triangles over the ray.
struct Corner {
  V h, t, z_by_w, by_w;
};

struct Cut {
  /// T, height and 1/w of an edge's crossing; bound of the error of t; how far along the edge it may really be
  V t, z, w, t_error, blur;
};

HWY_INLINE Corner pick(M first, const Corner& a, const Corner& b) {
  return {hn::IfThenElse(first, a.h, b.h), hn::IfThenElse(first, a.t, b.t), hn::IfThenElse(first, a.z_by_w, b.z_by_w),
          hn::IfThenElse(first, a.by_w, b.by_w)};
}

HWY_INLINE V by(V x) { return hn::Div(hn::Set(D(), 1.0f), x); }

/// In charts that are too wide for a polynomial.
template <Space kSpace>
HWY_NOINLINE V wide_arc(V t) {
  const D d;
  if constexpr (kSpace == Space::spherical) return arc_around(d, t, hn::Set(d, 1.0f));
  const V one = hn::Set(d, 1.0f), inside = hn::Min(hn::Set(d, 0.9999f), hn::Max(hn::Set(d, -0.9999f), t));
  return hn::Mul(hn::Set(d, 0.5f), log_of(d, hn::Div(hn::Add(one, inside), hn::Sub(one, inside))));
}

/// atanκ(t), to Chart::arc_error.
template <Space kSpace>
HWY_INLINE V arc(const Chart& chart, V t) {
  const D d;
  if constexpr (kSpace == Space::euclidean) return t;
  const auto c = [&](int k) { return hn::Set(d, chart.arc_poly[k]); };
  const V y = hn::Mul(t, t);
  if (HWY_LIKELY(chart.arc_terms == 4)) return hn::Mul(t, mul_add(y, mul_add(y, mul_add(y, c(3), c(2)), c(1)), c(0)));
  if (chart.arc_terms == 7) {
    const V high = mul_add(y, mul_add(y, mul_add(y, c(6), c(5)), c(4)), c(3));
    return hn::Mul(t, mul_add(y, mul_add(y, mul_add(y, high, c(2)), c(1)), c(0)));
  }
  return wide_arc<kSpace>(t);
}

template <Space kSpace>
HWY_INLINE Cut cut_edge(const ChartRay& ray, V size, const Corner& i, const Corner& j) {
  const D d;
  const V hi = hn::Abs(i.h), hj = hn::Abs(j.h);
  const V by_sum = by(hn::Add(hi, hj));
  Cut cut;
  cut.blur = hn::Mul(hn::Mul(hn::Set(d, 4 * ray.h_error), by_sum), size);
  cut.t = hn::Mul(by_sum, mul_add(hj, i.t, hn::Mul(hi, j.t)));
  cut.t_error = mul_add(cut.blur, hn::Set(d, ray.stretch), hn::Set(d, ray.t_error));
  cut.z = mul_add(hj, i.z_by_w, hn::Mul(hi, j.z_by_w));
  if constexpr (kSpace != Space::euclidean) {
    const V w = mul_add(hj, i.by_w, hn::Mul(hi, j.by_w));
    cut.z = hn::Mul(cut.z, by(w));
    cut.w = hn::Mul(w, by_sum);
  } else {
    cut.z = hn::Mul(cut.z, by_sum);
    cut.w = by_sum;
  }
  return cut;
}

/// What the float test of a block found out.
struct alignas(32) Verdict {
  float f_one[8], f_two[8];         ///< heights above the ray, times c, at the two crossings
  float nearer[8], farther[8];      ///< bounds of t at the triangle; of sure ones, of the hit
  std::uint32_t candidates = 0;     ///< bit per lane: the triangle may be met
  std::uint32_t sure = 0;           ///< of these: it is met exactly once, between the crossings
};

HWY_INLINE std::uint32_t bits_of(M mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(D(), mask, bits);
  return bits[0];
}

/// Which of eight triangles the ray may meet between `start` and `end`.
/// Conservative: with f = c·z − m·atanκ(t) − level at the two crossings, how far the triangle is above the ray there, a triangle is dropped
/// only when f has surely the same sign at both and either does not turn in between or is farther from 0 than the curve in
/// between can bend, or both crossings surely lie beside the ray's ends. It is sure when the signs surely differ and f does
/// not turn: f′ = 0 anywhere between needs |f₁ − f₂| ≤ max|f″|/2 = 4 bends.
template <Space kSpace>
HWY_INLINE void judge(const Block8& block, const Chart& chart, const ChartRay& ray, Verdict& verdict) {
  const D d;
  verdict.candidates = verdict.sure = 0;
  for (std::size_t lane = 0; lane < 8; lane += hn::Lanes(d)) {
    Corner corner[3];
    for (int i = 0; i < 3; ++i) {
      const V x = hn::Load(d, block.x[i] + lane), y = hn::Load(d, block.y[i] + lane);
      corner[i].t = mul_add(x, hn::Set(d, ray.t_x), hn::Mul(y, hn::Set(d, ray.t_y)));
      corner[i].h = mul_add(x, hn::Set(d, ray.h_x), mul_sub(y, hn::Set(d, ray.h_y), hn::Set(d, ray.h_0)));
      corner[i].z_by_w = hn::Load(d, block.z_by_w[i] + lane);
      corner[i].by_w = hn::Load(d, block.by_w[i] + lane);
    }
    const V h_error = hn::Set(d, ray.h_error), zero = hn::Zero(d);
    const V lowest = hn::Min(corner[0].h, hn::Min(corner[1].h, corner[2].h)),
            highest = hn::Max(corner[0].h, hn::Max(corner[1].h, corner[2].h));
    const M crosses = hn::And(hn::Le(lowest, h_error), hn::Ge(highest, hn::Neg(h_error)));
    if (hn::AllFalse(d, crosses)) continue;
    const M left0 = hn::Ge(corner[0].h, zero), left1 = hn::Ge(corner[1].h, zero), left2 = hn::Ge(corner[2].h, zero);
    const V nearest = hn::Min(hn::Abs(corner[0].h), hn::Min(hn::Abs(corner[1].h), hn::Abs(corner[2].h)));
    const M unsure = hn::Le(nearest, h_error);  // a corner on the ray's line: which edges are cut is not known
    const V size = hn::Load(d, block.size + lane);
    const Cut one = cut_edge<kSpace>(ray, size, pick(hn::Xor(left0, left1), corner[0], corner[2]), corner[1]);
    const Cut two = cut_edge<kSpace>(ray, size, pick(hn::Xor(left0, left2), corner[0], corner[1]), corner[2]);
    const V farther = hn::Max(hn::Add(one.t, one.t_error), hn::Add(two.t, two.t_error));
    const V nearer = hn::Min(hn::Sub(one.t, one.t_error), hn::Sub(two.t, two.t_error));
    const M late = hn::Gt(nearer, hn::Set(d, ray.reach));
    const V rise = hn::Set(d, ray.rise), run = hn::Set(d, ray.run), level = hn::Set(d, ray.level);
    const V f1 = hn::Sub(neg_mul_add(run, arc<kSpace>(chart, one.t), hn::Mul(rise, one.z)), level);
    const V f2 = hn::Sub(neg_mul_add(run, arc<kSpace>(chart, two.t), hn::Mul(rise, two.z)), level);
    V steep = hn::Set(d, ray.run_size), bend = zero;  // |m| times the largest slope of atanκ
    if constexpr (kSpace != Space::euclidean) {
      V sharp = hn::Set(d, ray.run_size * (0.66f / 8));  // |atan″| ≤ 0.65
      const V dt = hn::Abs(hn::Sub(one.t, two.t));
      if constexpr (kSpace == Space::hyperbolic) {  // atanh′ = 1/(1 − t²), atanh″ = 2t/(1 − t²)² < 2/(1 − t²)²
        const V most = hn::Max(hn::Abs(one.t), hn::Abs(two.t)), slope = by(neg_mul_add(most, most, hn::Set(d, 1.0f)));
        sharp = hn::Mul(hn::Mul(hn::Set(d, ray.run_size * (2.2f / 8)), most), hn::Mul(slope, slope));
        steep = hn::Mul(hn::Set(d, 1.05f * ray.run_size), slope);
      }
      const V dz = hn::Abs(hn::Sub(one.z, two.z)), dw = hn::Abs(hn::Sub(one.w, two.w));
      bend = mul_add(hn::Mul(dt, dt), sharp, hn::Mul(hn::Mul(dz, dw), hn::Set(d, ray.rise * chart.bend_of_height)));
    }
    const V level_error = hn::Set(d, ray.level_error), rise_blur = hn::Set(d, ray.rise_blur);
    const V e1 = mul_add(steep, one.t_error, mul_add(rise_blur, one.blur, level_error));
    const V e2 = mul_add(steep, two.t_error, mul_add(rise_blur, two.blur, level_error));
    const V least = hn::Min(hn::Sub(hn::Abs(f1), e1), hn::Sub(hn::Abs(f2), e2));
    const M signs_sure = hn::Gt(least, zero), opposite = hn::Lt(hn::Mul(f1, f2), zero);
    M beside = hn::AndNot(opposite, signs_sure), met = hn::And(opposite, signs_sure);
    if constexpr (kSpace != Space::euclidean) {
      const M steady = hn::Gt(hn::Abs(hn::Sub(f1, f2)), mul_add(hn::Set(d, 4.0f), bend, hn::Add(e1, e2)));
      beside = hn::And(beside, hn::Or(steady, hn::Gt(least, bend)));
      met = hn::And(met, steady);
    }
    verdict.sure |= bits_of(hn::AndNot(unsure, met)) << lane;
    const M missed = hn::Or(beside, hn::Or(late, hn::Lt(farther, hn::Set(d, ray.start))));
    hn::Store(f1, d, verdict.f_one + lane);
    hn::Store(f2, d, verdict.f_two + lane);
    hn::Store(nearer, d, verdict.nearer + lane);
    hn::Store(farther, d, verdict.farther + lane);
    const std::uint32_t bits = bits_of(hn::And(crosses, hn::Or(unsure, hn::Not(missed))));
    verdict.candidates |= bits << lane;
  }
}

}  // namespace orbc::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
