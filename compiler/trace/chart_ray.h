#pragma once
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
  float start = 0;                  ///< t where the ray begins (a little before)
  float reach = kNever;             ///< t where it ends (a little after)

  float t_x = 0, t_y = 0;           ///< t of a chart point = t_x·x + t_y·y
  float h_x = 0, h_y = 0, h_0 = 0;  ///< its distance from the line = h_x·x + h_y·y − h_0
  float h_error = 0, t_error = 0;   ///< bounds of the rounding of both
  float height = 0;                 ///< argument of tanκ = z·slope − height, unpadded
  float slope_error = 0;            ///< |slope| · bound of the rounding of heights
  double s0 = 0;                    ///< arc of the ray's start from Q
  double c = 1;
  bool misses = false;              ///< the geodesic stays away from all of the chart, or ends before it
};

/// In: heights of the soup are at most `height_bound`; the ray ends at path length t_max.
[[nodiscard]] ChartRay chart_ray(geometry::Space space, const Chart& chart, const Ray& ray, double height_bound, double t_max);

/// t of the path length `length` on the ray, a little more, or kNever when that lies beyond the chart.
[[nodiscard]] float t_after(geometry::Space space, const Chart& chart, const ChartRay& ray, double length);

}  // namespace orbc::trace
