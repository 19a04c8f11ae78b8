// Set-up of up to eight rays for a chart with SIMD. A ray is parametrised from the foot of the perpendicular from the chart's centre; that
// costs one square root and makes both the footprint and the node test those of a straight ray. The feet are computed in double and rounded
// once, so the paddings have to cover the float arithmetic alone (a few ulp of the chart's extent). The result of a ray does not depend on
// the other rays. Included once per instruction set, hence the guard.
#if defined(ORBC_TRACE_SET_UP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ORBC_TRACE_SET_UP_INL_H
#undef ORBC_TRACE_SET_UP_INL_H
#else
#define ORBC_TRACE_SET_UP_INL_H
#endif

#include <hwy/highway.h>

#include "compiler/trace/bvh/chart_ray.h"
#include "compiler/trace/bvh/traversal.h"
#include "compiler/trace/bvh/unfused-inl.h"

HWY_BEFORE_NAMESPACE();
namespace orbc::trace::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using V4 = hn::Vec<hn::CappedTag<double, 4>>;

/// The feet of the perpendiculars, per ray: computed in double and rounded to float.
struct alignas(64) PerpendicularFeet {
  float r[8], cx[8], cy[8], ex[8], ey[8], start[8], z[8], c[8], m[8];
  double over[8], under[8];  ///< arc of the start: atan2(over, under) on S², log(over)/2 on H², over on E²
  double r2[8];
};

template <geometry::Space kSpace>
HWY_INLINE void find_feet(const ChartTree& chart, const double in[9][8], std::size_t count, PerpendicularFeet& feet) {
  using geometry::Space;
  const hn::CappedTag<double, 4> d;
  const hn::Rebind<float, decltype(d)> df;
  const auto& map = chart.chart_from_room;
  constexpr double k = geometry::curvature(kSpace);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto load = [&](int f) { return hn::Load(d, in[f] + i); };
    const auto put = [&](V4 v, float* to) { hn::Store(hn::DemoteTo(df, v), df, to + i); };
    V4 pw = load(0), px = load(1), py = load(2), vw = load(3), vx = load(4), vy = load(5);
    if constexpr (kSpace == Space::euclidean) {
      px = hn::Add(px, hn::Set(d, map[1][0]));
      py = hn::Add(py, hn::Set(d, map[2][0]));
      const V4 along = hn::Add(hn::Mul(px, vx), hn::Mul(py, vy));
      put(hn::Set(d, 1.0), feet.r);
      put(hn::Sub(px, hn::Mul(along, vx)), feet.cx);
      put(hn::Sub(py, hn::Mul(along, vy)), feet.cy);
      put(vx, feet.ex);
      put(vy, feet.ey);
      put(along, feet.start);
      hn::Store(along, d, feet.over + i);
      continue;
    }
    if (chart.moved) {
      const auto row = [&](int j, V4 w, V4 x, V4 y) {
        return hn::Add(hn::Add(hn::Mul(hn::Set(d, map[j][0]), w), hn::Mul(hn::Set(d, map[j][1]), x)), hn::Mul(hn::Set(d, map[j][2]), y));
      };
      const V4 p0 = row(0, pw, px, py), p1 = row(1, pw, px, py), p2 = row(2, pw, px, py);
      const V4 v0 = row(0, vw, vx, vy), v1 = row(1, vw, vx, vy), v2 = row(2, vw, vx, vy);
      pw = p0, px = p1, py = p2, vw = v0, vx = v1, vy = v2;
    }
    const V4 kvw = hn::Mul(hn::Set(d, k), vw);
    const V4 r2 = hn::Add(hn::Mul(pw, pw), hn::Mul(kvw, vw)), r = hn::Sqrt(r2);
    const V4 by_r2 = hn::Div(hn::Set(d, 1.0), r2), by_r = hn::Mul(r, by_r2);
    put(r, feet.r);
    put(hn::Mul(hn::Add(hn::Mul(pw, px), hn::Mul(kvw, vx)), by_r2), feet.cx);
    put(hn::Mul(hn::Add(hn::Mul(pw, py), hn::Mul(kvw, vy)), by_r2), feet.cy);
    put(hn::Mul(hn::Sub(hn::Mul(pw, vx), hn::Mul(vw, px)), by_r), feet.ex);
    put(hn::Mul(hn::Sub(hn::Mul(pw, vy), hn::Mul(vw, py)), by_r), feet.ey);
    put(hn::Div(hn::Neg(kvw), pw), feet.start);
    hn::Store(r2, d, feet.r2 + i);
    if constexpr (kSpace == Space::spherical) {
      hn::Store(hn::Neg(vw), d, feet.over + i);
      hn::Store(pw, d, feet.under + i);
    } else {
      hn::Store(hn::Div(hn::Add(pw, vw), hn::Sub(pw, vw)), d, feet.over + i);
    }
  }
}

/// Arc lengths from the feet to the rays' starts, to a few ulp of float.
template <geometry::Space kSpace>
HWY_INLINE void find_arcs(const PerpendicularFeet& feet, std::size_t count, float s0[8]) {
  using geometry::Space;
  const hn::CappedTag<double, 4> dd;
  const hn::Rebind<float, decltype(dd)> d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(dd)) {
    const auto over = hn::DemoteTo(d, hn::Load(dd, feet.over + i));
    if constexpr (kSpace == Space::euclidean) {
      hn::Store(over, d, s0 + i);
    } else if constexpr (kSpace == Space::hyperbolic) {
      hn::Store(hn::Mul(hn::Set(d, 0.5f), log_of(d, over)), d, s0 + i);
    } else {
      hn::Store(arc_around(d, over, hn::DemoteTo(d, hn::Load(dd, feet.under + i))), d, s0 + i);
    }
  }
}

/// Sets up `count` ≤ 8 rays of the batch, from index `first` on.
template <geometry::Space kSpace>
HWY_INLINE void set_up_rays(const TraversalBatch& batch, std::size_t first, std::size_t count, ChartRay* out) {
  using geometry::Space;
  using namespace chart_ray_detail;
  const ChartTree& chart = *batch.chart;
  alignas(64) double in[9][8];
  for (std::size_t lane = 0; lane < (count <= 4 ? 4 : 8); ++lane) {
    const Ray& ray = batch.rays[first + std::min(lane, count - 1)];
    const double fields[9] = {ray.at.w, ray.at.x, ray.at.y, ray.along.w, ray.along.x, ray.along.y, ray.z, ray.c, ray.m};
    for (int f = 0; f < 9; ++f) in[f][lane] = fields[f];
  }
  PerpendicularFeet feet{};
  find_feet<kSpace>(chart, in, count, feet);
  for (std::size_t lane = 0; lane < count; ++lane) {
    feet.z[lane] = static_cast<float>(in[6][lane]);
    feet.c[lane] = static_cast<float>(in[7][lane]);
    feet.m[lane] = static_cast<float>(in[8][lane]);
  }
  alignas(64) float s0[8];
  find_arcs<kSpace>(feet, count, s0);
  const hn::CappedTag<float, 8> d;
  const float extent = chart.extent, ulp = static_cast<float>(kHalfUlp);
  const float margin = 16 * ulp * extent, margin_z = 16 * ulp * std::max(static_cast<float>(batch.height_bound), 0.02f) + 4e-9f * extent;
  alignas(64) float scale[3][8], near_offset[3][8], far_offset[3][8], h_0[8];
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const float* num[3] = {feet.r, feet.r, feet.c};
    const float* den[3] = {feet.ex, feet.ey, feet.m};
    const float* where[3] = {feet.cx, feet.cy, feet.z};
    for (int a = 0; a < 3; ++a) {
      const auto most = hn::Set(d, static_cast<float>(a == 2 ? kMaxHeightSlope : kMaxPlaneScale));
      const auto q = hn::Min(most, hn::Max(hn::Neg(most), hn::Div(hn::Load(d, num[a] + i), hn::Load(d, den[a] + i))));
      const auto at = hn::Load(d, where[a] + i);
      const auto pad = hn::CopySign(mul_add(hn::Set(d, 16 * ulp), hn::Abs(at), hn::Set(d, a == 2 ? margin_z : margin)), q);
      hn::Store(q, d, scale[a] + i);
      hn::Store(hn::Mul(hn::Add(at, pad), q), d, near_offset[a] + i);
      hn::Store(hn::Mul(hn::Sub(at, pad), q), d, far_offset[a] + i);
    }
    hn::Store(mul_sub(hn::Load(d, feet.ex + i), hn::Load(d, feet.cy + i), hn::Mul(hn::Load(d, feet.ey + i), hn::Load(d, feet.cx + i))), d,
              h_0 + i);
  }
  const float beyond = static_cast<float>(chart.radius * 1.0001 + 1e-6);
  for (std::size_t lane = 0; lane < count; ++lane) {
    ChartRay& ray = out[lane];
    const Ray& from = batch.rays[first + lane];
    const double t_max = batch.best[first + lane].t;
    float s = s0[lane];
    if (kSpace == Space::spherical && s > beyond) s -= 6.28318531f;
    ray.s0 = s;
    ray.misses = s > beyond || s + static_cast<float>(from.c * t_max) < -beyond;
    if constexpr (kSpace != Space::euclidean) {
      if (kSpace == Space::spherical ? feet.r2[lane] < chart.foot_bound2 : feet.r2[lane] > chart.foot_bound2) ray.misses = true;
    }
    if (ray.misses) continue;
    ray.c = from.c;
    const float start = feet.start[lane];
    ray.t_start =
        s < -static_cast<float>(chart.radius) ? -kEmptyBound : start - 48 * ulp * (static_cast<float>(chart.tan_radius) + std::fabs(start));
    set_ends<kSpace>(chart, from, t_max, ray);
    for (int a = 0; a < 3; ++a) ray.near[a] = std::signbit(scale[a][lane]);
    for (int a = 0; a < 2; ++a) {
      ray.scale[a] = scale[a][lane];
      ray.near_offset[a] = near_offset[a][lane];
      ray.far_offset[a] = far_offset[a][lane];
    }
    ray.slope = scale[2][lane];
    ray.t_per_length = feet.r[lane];
    ray.near_height = near_offset[2][lane] - s;
    ray.far_height = far_offset[2][lane] - s;
    ray.z_weight = feet.c[lane];
    ray.s_weight = feet.m[lane];
    ray.s_weight_size = std::fabs(ray.s_weight);
    ray.f_offset = static_cast<float>(from.c * from.z - from.m * double(s));
    ray.f_error =
        ray.z_weight * (margin_z + 16 * ulp * std::fabs(feet.z[lane])) + ray.s_weight_size * (chart.arc_error + 16 * ulp * std::fabs(s));
    ray.z_blur = ray.z_weight * chart.w_ratio_bound;
    ray.t_x = feet.ex[lane] * feet.r[lane];
    ray.t_y = feet.ey[lane] * feet.r[lane];
    ray.h_x = -feet.ey[lane];
    ray.h_y = feet.ex[lane];
    ray.h_0 = h_0[lane];
    ray.h_error = 16 * ulp * extent;
    ray.t_error = 20 * ulp * extent * feet.r[lane];
  }
}

}  // namespace orbc::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
