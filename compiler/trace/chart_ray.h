// A ray as the tree of one chart sees it; set up anew for every ray, hence in a header. The re-basing at the foot of the perpendicular is the
// performance study's first idea: it costs one square root and makes both the footprint and the node test those of a straight ray. Everything
// is computed in double and rounded once, so a bound of the float arithmetic alone (a few ulp of the chart's extent) is what the paddings cover.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/trace/arc.h"
#include "compiler/trace/chart.h"

namespace orbc::trace {

/// A ray as one chart's tree sees it, in float, with all paddings folded into the constants.
/// With Q the foot of the perpendicular from the chart's centre to the ray's geodesic, T the unit direction there and t = tanκ(arc from Q), the
/// chart point is C + e·t/R (C = Q_xy/Q_w, e = T_xy, R = Q_w): affine in t. The height is reached at t = tanκ(s0 + (z − z0)·q), q = c/m.
struct ChartRay {
  int near[3] = {0, 0, 0};          ///< which plane of a slab is met first, per axis
  float scale[2] = {0, 0};          ///< t = plane·scale − near_offset | far_offset
  float near_offset[2] = {0, 0}, far_offset[2] = {0, 0};
  float slope = 0, near_height = 0, far_height = 0;  ///< argument of tanκ = z·slope − near_height | far_height
  float steepness = 0, stretch = 1; ///< |slope| · Chart::ratio, and change of t per width of a triangle
  float start = 0;                  ///< t where the ray begins (a little before)
  float reach = kNever;             ///< t where it ends (a little after)
  float surely_after = 0, surely_before = 0;  ///< what lies between is met, whatever the rounding

  float t_x = 0, t_y = 0;           ///< t of a chart point = t_x·x + t_y·y
  float h_x = 0, h_y = 0, h_0 = 0;  ///< its distance from the line = h_x·x + h_y·y − h_0
  float h_error = 0, t_error = 0;   ///< bounds of the rounding of both
  float height = 0;                 ///< argument of tanκ = z·slope − height, unpadded
  float slope_error = 0;            ///< |slope| · bound of the rounding of heights
  double s0 = 0;                    ///< arc of the ray's start from Q
  double c = 1;
  bool misses = false;              ///< the geodesic stays away from all of the chart, or ends before it
};

namespace chart_ray_detail {
inline constexpr double kUlp = 0x1p-24;   // half an ulp of 1 in float
inline constexpr double kSteep = 1e9;     // |c/m| beyond this is a horizontal ray: its height changes less than the padding of heights
inline constexpr double kFlat = 1e15;     // the same for the slabs of the chart
}  // namespace chart_ray_detail

/// The ends of the ray in t, once s0 and start are known.
template <geometry::Space kSpace>
inline void set_ends(const Chart& chart, const Ray& ray, double t_max, ChartRay& out) {
  using chart_ray_detail::kUlp;
  const float pad = static_cast<float>(64 * kUlp * chart.extent);
  out.surely_after = ray.t_min > 1e-7 ? kNever : out.start > -kNever ? out.start + 4 * pad + 64 * static_cast<float>(kUlp) * std::fabs(out.start) : -kNever;
  out.reach = out.surely_before = kNever;
  if (t_max == kEndless) return;
  const double s = out.s0 + ray.c * t_max;
  if (!(s < chart.radius)) return;
  const double t = geometry::tan_k(kSpace, std::max(s, -chart.radius));
  out.reach = static_cast<float>(t + 32 * kUlp * (std::fabs(t) + chart.extent));
  out.surely_before = static_cast<float>(t - 32 * kUlp * (std::fabs(t) + chart.extent));
}

/// In: heights of the soup are at most `height_bound`; the ray ends at path length t_max.
template <geometry::Space kSpace>
[[nodiscard]] inline ChartRay chart_ray(const Chart& chart, const Ray& ray, double height_bound, double t_max) {
  using geometry::Ambient;
  using geometry::Space;
  using namespace chart_ray_detail;
  constexpr double k = geometry::curvature(kSpace);
  ChartRay out;
  Ambient p = ray.at, v = ray.along;
  if constexpr (kSpace == Space::euclidean) {
    p.x += chart.chart_from_room[1][0];
    p.y += chart.chart_from_room[2][0];
  } else if (chart.moved) {
    p = chart.chart_from_room * p;
    v = chart.chart_from_room * v;
  }
  double r = 1, cx, cy, ex, ey, start;
  if constexpr (kSpace == Space::euclidean) {
    start = out.s0 = p.x * v.x + p.y * v.y;
    ex = v.x;
    ey = v.y;
    cx = p.x - start * ex;
    cy = p.y - start * ey;
  } else {
    const double r2 = p.w * p.w + k * v.w * v.w;
    if (kSpace == Space::spherical ? r2 < chart.nearest_foot2 : r2 > chart.nearest_foot2) {
      out.misses = true;
      return out;
    }
    const double by_r2 = 1 / r2;
    r = std::sqrt(r2);
    const double by_r = r * by_r2;
    cx = (p.w * p.x + k * v.w * v.x) * by_r2;
    cy = (p.w * p.y + k * v.w * v.y) * by_r2;
    ex = (p.w * v.x - v.w * p.x) * by_r;
    ey = (p.w * v.y - v.w * p.y) * by_r;
    out.s0 = arc_of<kSpace>(p.w, -k * v.w);
    if (kSpace == Space::spherical && out.s0 > chart.radius) out.s0 -= 2 * std::numbers::pi;
    start = -k * v.w / p.w;
  }
  out.c = ray.c;
  const double beyond = chart.radius * 1.0001;
  if (out.s0 > beyond || out.s0 + ray.c * t_max < -beyond) {
    out.misses = true;
    return out;
  }
  out.start = out.s0 < -chart.radius ? -kNever : static_cast<float>(start - 32 * kUlp * (chart.tangent + std::fabs(start)));
  set_ends<kSpace>(chart, ray, t_max, out);
  // The two chart axes and the height alike, in float: the paddings cover it.
  const float extent = chart.extent, ulp = static_cast<float>(kUlp);
  const float num[3] = {static_cast<float>(r), static_cast<float>(r), static_cast<float>(ray.c)};
  const float den[3] = {static_cast<float>(ex), static_cast<float>(ey), static_cast<float>(ray.m)};
  const float at[3] = {static_cast<float>(cx), static_cast<float>(cy), static_cast<float>(ray.z)};
  const float most[3] = {static_cast<float>(kFlat), static_cast<float>(kFlat), static_cast<float>(kSteep)};
  const float margin[3] = {16 * ulp * extent, 16 * ulp * extent, 16 * ulp * std::max(static_cast<float>(height_bound), 0.02f) + 4e-9f * extent};
  float scale[3], pad[3], near_offset[3], far_offset[3];
  for (int a = 0; a < 3; ++a) {
    const float quotient = num[a] / den[a];
    scale[a] = std::min(most[a], std::max(-most[a], quotient));
    pad[a] = std::copysign(16 * ulp * std::fabs(at[a]) + margin[a], scale[a]);
    near_offset[a] = (at[a] + pad[a]) * scale[a];
    far_offset[a] = (at[a] - pad[a]) * scale[a];
    out.near[a] = std::signbit(scale[a]);
  }
  for (int a = 0; a < 2; ++a) {
    out.scale[a] = scale[a];
    out.near_offset[a] = near_offset[a];
    out.far_offset[a] = far_offset[a];
  }
  const float s0 = static_cast<float>(out.s0);
  out.slope = scale[2];
  out.steepness = std::fabs(scale[2]) * chart.ratio;
  out.stretch = static_cast<float>(r);
  out.near_height = near_offset[2] - s0;
  out.far_height = far_offset[2] - s0;
  out.height = at[2] * scale[2] - s0;
  out.slope_error = std::fabs(pad[2] * scale[2]) + 8 * ulp * std::fabs(s0);
  out.t_x = static_cast<float>(ex * r);
  out.t_y = static_cast<float>(ey * r);
  out.h_x = static_cast<float>(-ey);
  out.h_y = static_cast<float>(ex);
  out.h_0 = static_cast<float>(ex * cy - ey * cx);
  out.h_error = static_cast<float>(12 * kUlp * extent);
  out.t_error = static_cast<float>(16 * kUlp * extent * r);
  return out;
}

}  // namespace orbc::trace
