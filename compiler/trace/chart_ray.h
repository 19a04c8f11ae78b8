// A ray as the tree of one chart sees it; made by set_up-inl.h.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/trace/arc.h"
#include "compiler/trace/chart.h"

namespace orbc::trace {

/// A ray as one chart's tree sees it, in float, with all paddings folded into the constants. With Q the foot of the perpendicular from the
/// chart's centre to the ray's geodesic, T the unit direction there and t = tanκ(arc from Q), the chart point is C + e·t/R (C = Q_xy/Q_w, e
/// = T_xy, R = Q_w): affine in t. The height is reached at t = tanκ(s0 + (z − z0)·q), q = c/m.
struct ChartRay {
  int near[3] = {0, 0, 0};          ///< which plane of a slab is met first, per axis
  float scale[2] = {0, 0};          ///< t = plane·scale − near_offset | far_offset
  float near_offset[2] = {0, 0}, far_offset[2] = {0, 0};
  float slope = 0, near_height = 0, far_height = 0;  ///< argument of tanκ = z·slope − near_height | far_height
  float stretch = 1;                ///< change of t per width of a triangle
  float start = 0;                  ///< t where the ray begins (a little before)
  float reach = kNever;             ///< t where it ends (a little after)
  float surely_after = 0, surely_before = 0;  ///< what lies between is met, whatever the rounding

  float t_x = 0, t_y = 0;           ///< t of a chart point = t_x·x + t_y·y
  float h_x = 0, h_y = 0, h_0 = 0;  ///< its distance from the line = h_x·x + h_y·y − h_0
  float h_error = 0, t_error = 0;   ///< bounds of the rounding of both
  float rise = 1, run = 0, level = 0;  ///< c, m and c·z0 − m·s0: c·z − m·s − level is how far above the ray a point lies (times c)
  float level_error = 0;            ///< bound of the rounding of that
  float rise_blur = 0, run_size = 0;   ///< c · Chart::ratio, |m|
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
  out.surely_after = ray.t_min > 1e-7      ? kNever
                     : out.start > -kNever ? out.start + 4 * pad + 64 * static_cast<float>(kUlp) * std::fabs(out.start)
                                           : -kNever;
  out.reach = out.surely_before = kNever;
  if (t_max == kEndless) return;
  const double s = out.s0 + ray.c * t_max;
  if (!(s < chart.radius)) return;
  const double t = geometry::tan_k(kSpace, std::max(s, -chart.radius));
  out.reach = static_cast<float>(t + 32 * kUlp * (std::fabs(t) + chart.extent));
  out.surely_before = static_cast<float>(t - 32 * kUlp * (std::fabs(t) + chart.extent));
}

}  // namespace orbc::trace
