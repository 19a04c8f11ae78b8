#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/trace/arc.h"
#include "compiler/trace/bvh/chart_tree.h"

namespace orbc::trace {

/// A ray in the coordinates of one chart, in float, with all paddings included in the constants; made by ray_setup-inl.h. Let Q be the foot
/// of the perpendicular from the chart's centre to the ray's geodesic, T the unit direction there and t = tanκ(arc from Q). The chart point
/// is then C + e·t/R with C = Q_xy/Q_w, e = T_xy, R = Q_w, which is affine in t. The height z is reached at t = tanκ(s0 + (z − z0)·c/m).
struct ChartRay {
  int near[3] = {0, 0, 0};  ///< per axis: which plane of a slab is hit first (0 lower, 1 upper)
  float scale[2] = {0, 0};  ///< t = plane·scale − near_offset | far_offset
  float near_offset[2] = {0, 0}, far_offset[2] = {0, 0};
  float slope = 0, near_height = 0, far_height = 0;  ///< argument of tanκ = z·slope − near_height | far_height
  float t_per_length = 1;                            ///< change of t per length in the chart
  float t_start = 0;                                 ///< t of the ray's start, rounded down
  float t_end = kEmptyBound;                         ///< t of the ray's end, rounded up
  float certain_after = 0, certain_before = 0;       ///< hits with t between these bounds lie on the ray, whatever the rounding

  float t_x = 0, t_y = 0;           ///< t of a chart point: t_x·x + t_y·y
  float h_x = 0, h_y = 0, h_0 = 0;  ///< its distance from the ray's line: h_x·x + h_y·y − h_0
  float h_error = 0, t_error = 0;   ///< bounds of the rounding of h and t
  /// c, m and c·z0 − m·s0: a point (s, z) lies f = z_weight·z − s_weight·s − f_offset above the ray (times c).
  float z_weight = 1, s_weight = 0, f_offset = 0;
  float f_error = 0;                    ///< bound of the rounding of f
  float z_blur = 0, s_weight_size = 0;  ///< c · ChartTree::w_ratio_bound, |m|
  double s0 = 0;                        ///< arc of the ray's start from Q
  double c = 1;
  bool misses = false;  ///< the ray certainly hits nothing in the chart
};

namespace chart_ray_detail {
inline constexpr double kHalfUlp = 0x1p-24;  // half an ulp of 1 in float
// A ray with a larger |c/m| counts as horizontal: its height changes less than the padding of heights.
inline constexpr double kMaxHeightSlope = 1e9;
inline constexpr double kMaxPlaneScale = 1e15;  // the same for the slabs of the chart
}  // namespace chart_ray_detail

/// Sets the end of the ray in t. In: `out` with s0 and t_start.
template <geometry::Space kSpace>
inline void set_ends(const ChartTree& chart, const Ray& ray, double t_max, ChartRay& out) {
  using chart_ray_detail::kHalfUlp;
  const float pad = static_cast<float>(64 * kHalfUlp * chart.extent);
  out.certain_after = ray.t_min > 1e-7             ? kEmptyBound
                      : out.t_start > -kEmptyBound ? out.t_start + 4 * pad + 64 * static_cast<float>(kHalfUlp) * std::fabs(out.t_start)
                                                   : -kEmptyBound;
  out.t_end = out.certain_before = kEmptyBound;
  if (t_max == kInfinity) return;
  const double s = out.s0 + ray.c * t_max;
  if (!(s < chart.radius)) return;
  const double t = geometry::tan_k(kSpace, std::max(s, -chart.radius));
  out.t_end = static_cast<float>(t + 32 * kHalfUlp * (std::fabs(t) + chart.extent));
  out.certain_before = static_cast<float>(t - 32 * kHalfUlp * (std::fabs(t) + chart.extent));
}

}  // namespace orbc::trace
