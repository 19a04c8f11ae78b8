// The node test and the leaf test, eight boxes or triangles at a time. Highway includes this file once per instruction set, hence the
// guard.
#if defined(ORBC_TRACE_CLASSIFY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ORBC_TRACE_CLASSIFY_INL_H
#undef ORBC_TRACE_CLASSIFY_INL_H
#else
#define ORBC_TRACE_CLASSIFY_INL_H
#endif

#include <hwy/highway.h>

#include <cmath>

#include "compiler/trace/bvh/chart_ray.h"
#include "compiler/trace/bvh/unfused-inl.h"

HWY_BEFORE_NAMESPACE();
namespace orbc::trace::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using geometry::Space;
using D = hn::CappedTag<float, 8>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

/// tan_poly(a) + shift. The polynomial is odd and increases on all of ℝ, so that no clamp is needed however far a box lies.
template <int kTerms>
HWY_INLINE V odd_polynomial(const ChartTree& chart, V a, V shift) {
  const D d;
  if constexpr (kTerms == 1) return hn::Add(a, shift);
  const auto c = [&](int k) { return hn::Set(d, chart.tan_poly[k]); };
  const V y = hn::Mul(a, a);  // Estrin's scheme, for the latency of the dependent operations
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

/// Bit per child of the node whose box the ray may intersect between ray.t_start and `end`; entry_t gets the t at which it enters each box.
template <int kTerms>
HWY_INLINE std::uint32_t intersected_children(const Node8& node, const ChartTree& chart, const ChartRay& ray, float end,
                                              float* HWY_RESTRICT entry_t) {
  const D d;
  std::uint32_t bits = 0;
  const V error = hn::Set(d, chart.tan_error), minus_error = hn::Set(d, -chart.tan_error);
  for (std::size_t i = 0; i < 8; i += hn::Lanes(d)) {
    V near = hn::Set(d, ray.t_start), far = hn::Set(d, end);
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
    hn::Store(near, d, entry_t + i);
    std::uint8_t mask[8] = {};
    hn::StoreMaskBits(d, hn::Le(near, far), mask);
    bits |= static_cast<std::uint32_t>(mask[0]) << i;
  }
  return bits;
}

/// One corner of each of eight triangles: distance h from the ray's line, t, z/w and 1/w.
struct Corner {
  V h, t, z_by_w, by_w;
};

/// Where the ray's line cuts an edge: t, height and 1/w, the bound of t's error, and the bound of the position's error along the edge.
struct EdgeCut {
  V t, z, w, t_error, blur;
};

HWY_INLINE Corner select(M first, const Corner& a, const Corner& b) {
  return {hn::IfThenElse(first, a.h, b.h), hn::IfThenElse(first, a.t, b.t), hn::IfThenElse(first, a.z_by_w, b.z_by_w),
          hn::IfThenElse(first, a.by_w, b.by_w)};
}

HWY_INLINE V reciprocal(V x) { return hn::Div(hn::Set(D(), 1.0f), x); }

/// atanκ(t) for charts that are too wide for a polynomial.
template <Space kSpace>
HWY_NOINLINE V general_arc(V t) {
  const D d;
  if constexpr (kSpace == Space::spherical) return arc_around(d, t, hn::Set(d, 1.0f));
  const V one = hn::Set(d, 1.0f), inside = hn::Min(hn::Set(d, 0.9999f), hn::Max(hn::Set(d, -0.9999f), t));
  return hn::Mul(hn::Set(d, 0.5f), log_of(d, hn::Div(hn::Add(one, inside), hn::Sub(one, inside))));
}

/// atanκ(t), to ChartTree::arc_error.
template <Space kSpace>
HWY_INLINE V arc(const ChartTree& chart, V t) {
  const D d;
  if constexpr (kSpace == Space::euclidean) return t;
  const auto c = [&](int k) { return hn::Set(d, chart.arc_poly[k]); };
  const V y = hn::Mul(t, t);
  if (HWY_LIKELY(chart.arc_terms == 4)) return hn::Mul(t, mul_add(y, mul_add(y, mul_add(y, c(3), c(2)), c(1)), c(0)));
  if (chart.arc_terms == 7) {
    const V high = mul_add(y, mul_add(y, mul_add(y, c(6), c(5)), c(4)), c(3));
    return hn::Mul(t, mul_add(y, mul_add(y, mul_add(y, high, c(2)), c(1)), c(0)));
  }
  return general_arc<kSpace>(t);
}

template <Space kSpace>
HWY_INLINE EdgeCut cut_edge(const ChartRay& ray, V size, const Corner& i, const Corner& j) {
  const D d;
  const V hi = hn::Abs(i.h), hj = hn::Abs(j.h);
  const V by_sum = reciprocal(hn::Add(hi, hj));
  EdgeCut cut;
  cut.blur = hn::Mul(hn::Mul(hn::Set(d, 4 * ray.h_error), by_sum), size);
  cut.t = hn::Mul(by_sum, mul_add(hj, i.t, hn::Mul(hi, j.t)));
  cut.t_error = mul_add(cut.blur, hn::Set(d, ray.t_per_length), hn::Set(d, ray.t_error));
  cut.z = mul_add(hj, i.z_by_w, hn::Mul(hi, j.z_by_w));
  if constexpr (kSpace != Space::euclidean) {
    const V w = mul_add(hj, i.by_w, hn::Mul(hi, j.by_w));
    cut.z = hn::Mul(cut.z, reciprocal(w));
    cut.w = hn::Mul(w, by_sum);
  } else {
    cut.z = hn::Mul(cut.z, by_sum);
    cut.w = by_sum;
  }
  return cut;
}

/// The result of the float test of a block.
struct alignas(32) LeafResult {
  float f_first[8], f_second[8];    ///< f at the two edge cuts
  float t_lower[8], t_upper[8];     ///< bounds of t on the triangle, and therefore of its hit
  std::uint32_t candidates = 0;     ///< bit per lane: the triangle may be hit
  std::uint32_t certainly_hit = 0;  ///< bit per lane: it is certainly hit exactly once, between the edge cuts
};

HWY_INLINE std::uint32_t bits_of(M mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(D(), mask, bits);
  return bits[0];
}

/// Classifies eight triangles: certainly missed, possibly hit, certainly hit once, between ray.t_start and ray.t_end.
/// Formula: f = c·z − m·atanκ(t) − f_offset at the two edge cuts says how far the triangle lies above the ray there. A triangle is missed
/// if
///          both cuts certainly lie outside of the ray's interval of t. It is also missed if f certainly has the same sign at both cuts and
///          either is monotone between them or differs from 0 by more than it can deviate from its chord (`bend`). It is certainly hit once
///          if the signs certainly differ and f is monotone; f′ = 0 in between needs |f₁ − f₂| ≤ max|f″|/2 = 4·bend.
template <Space kSpace>
HWY_INLINE void classify_block(const Block8& block, const ChartTree& chart, const ChartRay& ray, LeafResult& leaf) {
  const D d;
  leaf.candidates = leaf.certainly_hit = 0;
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
    const M vertex_on_line = hn::Le(nearest, h_error);  // then it is not known which edges are cut
    const V size = hn::Load(d, block.size + lane);
    const EdgeCut first = cut_edge<kSpace>(ray, size, select(hn::Xor(left0, left1), corner[0], corner[2]), corner[1]);
    const EdgeCut second = cut_edge<kSpace>(ray, size, select(hn::Xor(left0, left2), corner[0], corner[1]), corner[2]);
    const V t_upper = hn::Max(hn::Add(first.t, first.t_error), hn::Add(second.t, second.t_error));
    const V t_lower = hn::Min(hn::Sub(first.t, first.t_error), hn::Sub(second.t, second.t_error));
    const M behind_end = hn::Gt(t_lower, hn::Set(d, ray.t_end));
    const V z_weight = hn::Set(d, ray.z_weight), s_weight = hn::Set(d, ray.s_weight), f_offset = hn::Set(d, ray.f_offset);
    const V f1 = hn::Sub(neg_mul_add(s_weight, arc<kSpace>(chart, first.t), hn::Mul(z_weight, first.z)), f_offset);
    const V f2 = hn::Sub(neg_mul_add(s_weight, arc<kSpace>(chart, second.t), hn::Mul(z_weight, second.z)), f_offset);
    V max_slope = hn::Set(d, ray.s_weight_size), bend = zero;  // |m| times the largest slope of atanκ
    if constexpr (kSpace != Space::euclidean) {
      V max_curvature = hn::Set(d, ray.s_weight_size * (0.66f / 8));  // |atan″| ≤ 0.65
      const V dt = hn::Abs(hn::Sub(first.t, second.t));
      if constexpr (kSpace == Space::hyperbolic) {  // atanh′ = 1/(1 − t²), atanh″ = 2t/(1 − t²)² < 2/(1 − t²)²
        const V max_t = hn::Max(hn::Abs(first.t), hn::Abs(second.t)), slope = reciprocal(neg_mul_add(max_t, max_t, hn::Set(d, 1.0f)));
        max_curvature = hn::Mul(hn::Mul(hn::Set(d, ray.s_weight_size * (2.2f / 8)), max_t), hn::Mul(slope, slope));
        max_slope = hn::Mul(hn::Set(d, 1.05f * ray.s_weight_size), slope);
      }
      const V dz = hn::Abs(hn::Sub(first.z, second.z)), dw = hn::Abs(hn::Sub(first.w, second.w));
      bend = mul_add(hn::Mul(dt, dt), max_curvature, hn::Mul(hn::Mul(dz, dw), hn::Set(d, ray.z_weight * chart.height_bend_bound)));
    }
    const V f_error = hn::Set(d, ray.f_error), z_blur = hn::Set(d, ray.z_blur);
    const V e1 = mul_add(max_slope, first.t_error, mul_add(z_blur, first.blur, f_error));
    const V e2 = mul_add(max_slope, second.t_error, mul_add(z_blur, second.blur, f_error));
    const V margin = hn::Min(hn::Sub(hn::Abs(f1), e1), hn::Sub(hn::Abs(f2), e2));
    const M signs_certain = hn::Gt(margin, zero), opposite = hn::Lt(hn::Mul(f1, f2), zero);
    M same_side = hn::AndNot(opposite, signs_certain), hit = hn::And(opposite, signs_certain);
    if constexpr (kSpace != Space::euclidean) {
      const M monotone = hn::Gt(hn::Abs(hn::Sub(f1, f2)), mul_add(hn::Set(d, 4.0f), bend, hn::Add(e1, e2)));
      same_side = hn::And(same_side, hn::Or(monotone, hn::Gt(margin, bend)));
      hit = hn::And(hit, monotone);
    }
    leaf.certainly_hit |= bits_of(hn::AndNot(vertex_on_line, hit)) << lane;
    const M missed = hn::Or(same_side, hn::Or(behind_end, hn::Lt(t_upper, hn::Set(d, ray.t_start))));
    hn::Store(f1, d, leaf.f_first + lane);
    hn::Store(f2, d, leaf.f_second + lane);
    hn::Store(t_lower, d, leaf.t_lower + lane);
    hn::Store(t_upper, d, leaf.t_upper + lane);
    const std::uint32_t bits = bits_of(hn::And(crosses, hn::Or(vertex_on_line, hn::Not(missed))));
    leaf.candidates |= bits << lane;
  }
}

}  // namespace orbc::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
