// Set-up of a ray for a chart. The re-basing at the foot of the perpendicular is the performance study's first idea: it costs one square root
// and makes both the footprint and the node test those of a straight ray. Everything is computed in double and rounded once, so a bound of the
// float arithmetic alone (a few ulp of the chart's extent) is what the paddings must cover.
#include "compiler/trace/chart_ray.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orbc::trace {

using geometry::Ambient;
using geometry::Space;

namespace {

constexpr double kUlp = 0x1p-24;   // half an ulp of 1 in float
constexpr double kSteep = 1e9;     // |c/m| beyond this is a horizontal ray: its height changes less than the padding of heights
constexpr double kFlat = 1e15;     // the same for the slabs of the chart

}  // namespace

ChartRay chart_ray(Space space, const Chart& chart, const Ray& ray, double height_bound, double t_max) {
  ChartRay out;
  const Ambient p = chart.chart_from_room * ray.at;
  const Ambient v = chart.chart_from_room * Ambient(ray.along);
  double r, cx, cy, ex, ey;
  if (space == Space::euclidean) {
    const double along = p.x * v.x + p.y * v.y;
    r = 1;
    out.s0 = along;
    ex = v.x;
    ey = v.y;
    cx = p.x - along * ex;
    cy = p.y - along * ey;
  } else {
    const double k = geometry::curvature(space);
    r = std::sqrt(p.w * p.w + k * v.w * v.w);
    if (space == Space::spherical ? r < std::cos(chart.radius * 1.0001) : r > std::cosh(chart.radius * 1.0001)) {
      out.misses = true;
      return out;
    }
    const double by_r = 1 / r, by_r2 = by_r * by_r;
    cx = (p.w * p.x + k * v.w * v.x) * by_r2;
    cy = (p.w * p.y + k * v.w * v.y) * by_r2;
    ex = (p.w * v.x - v.w * p.x) * by_r;
    ey = (p.w * v.y - v.w * p.y) * by_r;
    out.s0 = space == Space::spherical ? std::atan2(-v.w, p.w) : std::atanh(v.w / p.w);
    if (space == Space::spherical && out.s0 > chart.radius) out.s0 -= 2 * std::numbers::pi;
  }
  out.c = ray.c;
  const double tangent = geometry::tan_k(space, chart.radius);
  out.start = out.s0 < -chart.radius ? -kNever
                                     : static_cast<float>(space == Space::spherical   ? -v.w / p.w
                                                          : space == Space::euclidean ? out.s0
                                                                                      : v.w / p.w);
  if (out.start > -kNever) out.start -= static_cast<float>(32 * kUlp * (tangent + std::fabs(out.start)));
  if (out.s0 > chart.radius * 1.0001 || out.s0 + ray.c * t_max < -chart.radius * 1.0001) {
    out.misses = true;
    return out;
  }
  out.reach = t_after(space, chart, out, t_max);
  const double extent = chart.extent;
  const double direction[2] = {ex, ey}, foot[2] = {cx, cy};
  for (int a = 0; a < 2; ++a) {
    const double scale = std::fabs(direction[a]) * kFlat > r ? r / direction[a] : std::copysign(kFlat, direction[a]);
    const double pad = 16 * kUlp * std::max(extent, std::fabs(foot[a]));
    out.near[a] = scale > 0 ? 0 : 1;
    out.scale[a] = static_cast<float>(scale);
    out.near_offset[a] = static_cast<float>((foot[a] + std::copysign(pad, scale)) * scale);
    out.far_offset[a] = static_cast<float>((foot[a] - std::copysign(pad, scale)) * scale);
  }
  const double slope = std::fabs(ray.m) * kSteep > ray.c ? ray.c / ray.m : std::copysign(kSteep, ray.m);
  const double height_error = 12 * kUlp * (std::max(height_bound, 0.02) + std::fabs(ray.z)) + 4e-9 * extent;
  out.near[2] = slope >= 0 ? 0 : 1;
  out.slope = static_cast<float>(slope);
  out.near_height = static_cast<float>((ray.z + std::copysign(height_error, slope)) * slope - out.s0);
  out.far_height = static_cast<float>((ray.z - std::copysign(height_error, slope)) * slope - out.s0);
  out.height = static_cast<float>(ray.z * slope - out.s0);
  out.slope_error = static_cast<float>(std::fabs(slope) * height_error + 8 * kUlp * std::fabs(out.s0));
  out.t_x = static_cast<float>(ex * r);
  out.t_y = static_cast<float>(ey * r);
  out.h_x = static_cast<float>(-ey);
  out.h_y = static_cast<float>(ex);
  out.h_0 = static_cast<float>(ex * cy - ey * cx);
  out.h_error = static_cast<float>(12 * kUlp * extent);
  out.t_error = static_cast<float>(16 * kUlp * extent * r);
  return out;
}

float t_after(Space space, const Chart& chart, const ChartRay& ray, double length) {
  const double s = ray.s0 + ray.c * length;
  if (!(s < chart.radius)) return kNever;
  if (s < -chart.radius * 1.001) return -kNever;
  const double t = geometry::tan_k(space, s);
  return static_cast<float>(t + 32 * kUlp * (std::fabs(t) + chart.extent));
}

}  // namespace orbc::trace
