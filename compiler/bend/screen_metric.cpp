// The error of a chord is the angle, at the eye, between a true point and the nearest visible point of the chord. The depth along the line
// of sight is invisible, but it decides which surface hides which and where surfaces intersect; so its relative error has the same bound.
// Chords that lie outside of a perspective picture by more than their own error may be kOffscreenFactor times coarser: they are never
// drawn, but the exported scene can be turned in a viewer and should still show a room.
#include "compiler/bend/screen_metric.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "compiler/base/elementary.h"

namespace orbc::bend {
namespace {

using geometry::Vector3;

constexpr double kFrameMarginRadians = 0.02;
constexpr double kBetweenPoints = 1.03;  // the largest error may lie between the measured points; measured up to 1.014

double segment_distance(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Vector3 ab = b - a, ap = p - a;
  const double l2 = dot(ab, ab);
  const double t = l2 > 0 ? std::clamp(dot(ap, ab) / l2, 0.0, 1.0) : 0;
  return length(ap - t * ab);
}

/// The tangent of the angle between the unit direction d and the nearest visible point of the segment a b. Nothing when the segment spans
/// more than about a right angle from d.
std::optional<double> visible_distance(const Vector3& d, const Vector3& a, const Vector3& b) {
  const double da = dot(a, d), db = dot(b, d);
  if (da < 0.05 * length(a) || db < 0.05 * length(b) || da <= 0 || db <= 0) return std::nullopt;
  return segment_distance({0, 0, 0}, (1 / da) * a - d, (1 / db) * b - d);
}

/// The part of v across the unit direction d.
double across(const Vector3& d, const Vector3& v) { return length(v - dot(v, d) * d); }

/// In: all points between which the error lies, from the eye; an angle, and pixels per radian.
ChordError error_in_picture(const ScreenMetric& metric, double angle, double pixels, std::span<const Vector3> points) {
  const double tolerances = kBetweenPoints * angle * pixels / metric.tolerance;
  if (!metric.framed) return {tolerances, true, 0};
  for (const Vector3& n : metric.outward) {
    const auto is_outside = [&](const Vector3& p) { return dot(p, n) > (kFrameMarginRadians + 2 * angle) * length(p); };
    if (std::all_of(points.begin(), points.end(), is_outside)) return {tolerances / kOffscreenFactor, false, 0};
  }
  return {tolerances, true, 0};
}

/// Of the tolerance. Far out in the chart of S² everything is large, so the tolerance grows with the distance; with an eye in the chart,
/// with that from the eye.
double disk_scale(const ScreenMetric& metric, const Vector3& p) {
  return metric.chart_eye ? std::max(length(p - metric.eye), 1e-9) : std::max(1.0, math::hypot(p.x, p.y));
}

ChordError measure_chord_in_disk(const ScreenMetric& metric, const Vector3& a, const Vector3& b, std::span<const CurvePoint> curve,
                                 double color_tolerance) {
  double largest = 0;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vector3& p = curve[i].image;
    const double scale = disk_scale(metric, p);
    double off = segment_distance(p, a, b);
    if (color_tolerance > 0) off = std::max(off, length(p - (a + curve[i].parameter * (b - a))) / color_tolerance);
    if (off / scale > largest) {
      largest = off / scale;
      worst = i;
    }
  }
  return {kBetweenPoints * largest / metric.tolerance, true, worst};
}

}  // namespace

ScreenMetric screen_metric(const place::Camera& eye, const BendOptions& options) {
  ScreenMetric metric;
  metric.view = options.view;
  metric.eye = {0, 0, eye.z};
  metric.forward = eye.forward;
  metric.camera = eye;
  metric.tolerance = options.view == View::disk ? options.disk_tolerance : options.tolerance_px;
  if (options.view == View::disk && !options.chart_eye) return metric;
  const double wide = math::tan(eye.fov.radians / 2), high = wide * eye.height / eye.width;
  switch (eye.projection) {
    case scene::Projection::perspective:
      metric.pixels = eye.width / (2 * wide);
      metric.cos_border = 1 / std::sqrt(1 + wide * wide + high * high);
      metric.framed = true;
      for (int side : {-1, 1}) {
        metric.outward[side < 0 ? 0 : 1] = normalised(static_cast<double>(side) * eye.right - wide * eye.forward);
        metric.outward[side < 0 ? 2 : 3] = normalised(static_cast<double>(side) * eye.up - high * eye.forward);
      }
      break;
    case scene::Projection::panorama:
    case scene::Projection::stereo:  // no export has it
      metric.pixels = eye.width / (2 * std::numbers::pi);
      metric.cos_border = 0.25;  // the rows near the poles show one direction many times
      break;
    case scene::Projection::cylinder:
      metric.pixels = eye.width / eye.fov.radians;
      metric.cos_border = 1 / math::hypot(1, eye.fov.radians / 2 * eye.height / eye.width);
      break;
  }
  if (options.view == View::disk) {
    metric.chart_eye = true;
    metric.eye = *options.chart_eye;
    metric.tolerance = options.tolerance_px / max_pixels_per_radian(metric);
  }
  return metric;
}

double pixels_per_radian_at(const ScreenMetric& metric, const Vector3& d) {
  switch (metric.camera.projection) {
    case scene::Projection::perspective: {
      const double c = std::max(dot(d, metric.forward), metric.cos_border);
      return metric.pixels / (c * c);
    }
    case scene::Projection::panorama:
      return metric.pixels / std::max(math::hypot(d.x, d.y), metric.cos_border);
    default: {
      const double c = std::max(math::hypot(d.x, d.y), metric.cos_border);
      return metric.pixels / (c * c);
    }
  }
}

double max_pixels_per_radian(const ScreenMetric& metric) {
  if (metric.camera.projection == scene::Projection::panorama) return metric.pixels / metric.cos_border;
  return metric.pixels / (metric.cos_border * metric.cos_border);
}

ChordError measure_chord(const ScreenMetric& metric, const Vector3& a, const Vector3& b, std::span<const CurvePoint> curve,
                         double color_tolerance) {
  if (metric.view == View::disk) return measure_chord_in_disk(metric, a, b, curve, color_tolerance);
  const Vector3 da = a - metric.eye, db = b - metric.eye;
  double angle = 0, pixels = 0;
  std::size_t worst = 0;
  std::array<Vector3, 16> points{da, db};
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vector3 p = curve[i].image - metric.eye;
    points[2 + i] = p;
    const double far = std::max(length(p), 1e-9);
    const Vector3 d = (1 / far) * p;
    const double off = segment_distance(p, da, db) / far;
    double here = std::max(visible_distance(d, da, db).value_or(off), off);
    if (color_tolerance > 0) here = std::max(here, across(d, p - (da + curve[i].parameter * (db - da))) / far / color_tolerance);
    if (here > angle) {
      angle = here;
      worst = i;
    }
    pixels = std::max(pixels, pixels_per_radian_at(metric, d));
  }
  ChordError error = error_in_picture(metric, angle, pixels, std::span<const Vector3>(points).first(2 + curve.size()));
  error.worst_point = worst;
  return error;
}

ChordError measure_centre(const ScreenMetric& metric, const std::array<Vector3, 3>& corners, const Vector3& centre,
                          double color_tolerance) {
  const Vector3 &a = corners[0], &b = corners[1], &c = corners[2];
  const Vector3 normal = cross(b - a, c - a), flat = (1.0 / 3) * (a + b + c), off = centre - flat;
  const double area = length(normal), height = area > 0 ? std::fabs(dot(off, normal)) / area : length(off);
  if (metric.view == View::disk) {
    const double wrong = color_tolerance > 0 ? std::max(height, length(off) / color_tolerance) : height;
    return {wrong / disk_scale(metric, centre) / metric.tolerance, true, 0};
  }
  const Vector3 p = centre - metric.eye;
  const double far = std::max(length(p), 1e-9);
  const Vector3 d = (1 / far) * p;
  // Where the ray to the centre passes through the flat triangle, only the depth is wrong.
  const Vector3 e[3] = {a - metric.eye, b - metric.eye, c - metric.eye};
  const double s0 = dot(cross(e[0], e[1]), d), s1 = dot(cross(e[1], e[2]), d), s2 = dot(cross(e[2], e[0]), d);
  const bool through = (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
  double seen = 0;  // the angle by which the error is visible
  if (!through) {
    seen = height / far;
    for (int i = 0; i < 3; ++i) seen = std::min(seen, visible_distance(d, e[i], e[(i + 1) % 3]).value_or(seen));
  }
  double angle = std::max(seen, height / far);
  if (color_tolerance > 0) angle = std::max(angle, across(d, off) / far / color_tolerance);
  const Vector3 points[] = {e[0], e[1], e[2], p};
  return error_in_picture(metric, angle, pixels_per_radian_at(metric, d), points);
}

}  // namespace orbc::bend
