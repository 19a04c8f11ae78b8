// An error counts as it is seen: a chord is wrong by the angle between the true point and the nearest seen point of the chord. Depth along
// the line of sight is invisible but decides what hides what, and where two surfaces meet: it may be wrong by as much and no more. What
// lies outside of a perspective picture, by more than its own error, may be kOutside times coarser: it can never be drawn, but who turns
// the exported scene in a viewer should still see a room.
#include "compiler/bend/sight.h"

#include <algorithm>
#include <cmath>

#include "compiler/base/elementary.h"

namespace orbc::bend {
namespace {

using geometry::Vector3;

constexpr double kFrameMargin = 0.02;  // radians
constexpr double kBetween = 1.03;      // the largest error may lie between the points looked at; measured up to 1.014

double segment_distance(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Vector3 ab = b - a, ap = p - a;
  const double l2 = dot(ab, ab);
  const double t = l2 > 0 ? std::clamp(dot(ap, ab) / l2, 0.0, 1.0) : 0;
  return length(ap - t * ab);
}

/// The angle (its tangent) between the unit direction d and the nearest seen point of the segment a b; negative when it cannot tell because
/// the segment spans more than a right angle from d.
double seen_from(const Vector3& d, const Vector3& a, const Vector3& b) {
  const double da = dot(a, d), db = dot(b, d);
  if (da < 0.05 * length(a) || db < 0.05 * length(b) || da <= 0 || db <= 0) return -1;
  return segment_distance({0, 0, 0}, (1 / da) * a - d, (1 / db) * b - d);
}

double across(const Vector3& d, const Vector3& v) { return length(v - dot(v, d) * d); }

Judgement in_frame(const Sight& sight, double angle, double pixels, const Vector3* points, int count) {
  const double share = kBetween * angle * pixels / sight.tolerance;
  if (!sight.framed) return {share, true, 0};
  for (const Vector3& n : sight.outward) {
    bool outside = true;
    for (int i = 0; i < count && outside; ++i) outside = dot(points[i], n) > (kFrameMargin + 2 * angle) * length(points[i]);
    if (outside) return {share / kOutside, false, 0};
  }
  return {share, true, 0};
}

}  // namespace

Sight sight_of(const place::Eye& eye, const BendOptions& options) {
  Sight sight;
  sight.view = options.view;
  sight.eye = {0, 0, eye.z};
  sight.forward = eye.forward;
  sight.camera = eye;
  sight.tolerance = options.view == View::disk ? options.disk_tolerance : options.tolerance_px;
  if (options.view == View::disk) return sight;
  const double wide = math::tan(eye.fov.radians / 2), high = wide * eye.height / eye.width;
  switch (eye.projection) {
    case scene::Projection::perspective:
      sight.pixels = eye.width / (2 * wide);
      sight.cos_border = 1 / std::sqrt(1 + wide * wide + high * high);
      sight.framed = true;
      for (int side : {-1, 1}) {
        sight.outward[side < 0 ? 0 : 1] = normalised(static_cast<double>(side) * eye.right - wide * eye.forward);
        sight.outward[side < 0 ? 2 : 3] = normalised(static_cast<double>(side) * eye.up - high * eye.forward);
      }
      break;
    case scene::Projection::panorama:
      sight.pixels = eye.width / (2 * std::numbers::pi);
      sight.cos_border = 0.25;  // the rows near the poles show one direction many times
      break;
    case scene::Projection::cylinder:
      sight.pixels = eye.width / eye.fov.radians;
      sight.cos_border = 1 / math::hypot(1, eye.fov.radians / 2 * eye.height / eye.width);
      break;
  }
  return sight;
}

double pixels_at(const Sight& sight, const Vector3& d) {
  switch (sight.camera.projection) {
    case scene::Projection::perspective: {
      const double c = std::max(dot(d, sight.forward), sight.cos_border);
      return sight.pixels / (c * c);
    }
    case scene::Projection::panorama:
      return sight.pixels / std::max(math::hypot(d.x, d.y), sight.cos_border);
    default: {
      const double c = std::max(math::hypot(d.x, d.y), sight.cos_border);
      return sight.pixels / (c * c);
    }
  }
}

double densest(const Sight& sight) {
  if (sight.camera.projection == scene::Projection::panorama) return sight.pixels / sight.cos_border;
  return sight.pixels / (sight.cos_border * sight.cos_border);
}

Judgement judge_chord(const Sight& sight, const Vector3& a, const Vector3& b, const Vector3* curve, const double* parameter, int count,
                      double along) {
  if (sight.view == View::disk) {
    double worst = 0;
    int farthest = 0;
    for (int i = 0; i < count; ++i) {
      // Far out in the chart of S² everything is large: there the tolerance grows with the distance.
      const double scale = std::max(1.0, math::hypot(curve[i].x, curve[i].y));
      const double off = along > 0 ? std::max(segment_distance(curve[i], a, b), length(curve[i] - (a + parameter[i] * (b - a))) / along)
                                   : segment_distance(curve[i], a, b);
      if (off / scale > worst) worst = off / scale, farthest = i;
    }
    return {kBetween * worst / sight.tolerance, true, farthest};
  }
  const Vector3 da = a - sight.eye, db = b - sight.eye;
  double angle = 0, pixels = 0;
  int farthest = 0;
  Vector3 points[16] = {da, db};
  for (int i = 0; i < count; ++i) {
    const Vector3 p = curve[i] - sight.eye;
    points[2 + i] = p;
    const double far = std::max(length(p), 1e-9);
    const Vector3 d = (1 / far) * p;
    const double off = segment_distance(p, da, db) / far, seen = seen_from(d, da, db);
    double here = seen < 0 ? off : std::max(seen, off);
    if (along > 0) here = std::max(here, across(d, p - (da + parameter[i] * (db - da))) / far / along);
    if (here > angle) angle = here, farthest = i;
    pixels = std::max(pixels, pixels_at(sight, d));
  }
  Judgement judgement = in_frame(sight, angle, pixels, points, 2 + count);
  judgement.worst = farthest;
  return judgement;
}

Judgement judge_centre(const Sight& sight, const std::array<Vector3, 3>& corners, const Vector3& centre, double along) {
  const Vector3 &a = corners[0], &b = corners[1], &c = corners[2];
  const Vector3 normal = cross(b - a, c - a), flat = (1.0 / 3) * (a + b + c), off = centre - flat;
  const double area = length(normal), height = area > 0 ? std::fabs(dot(off, normal)) / area : length(off);
  if (sight.view == View::disk) {
    const double wrong = along > 0 ? std::max(height, length(off) / along) : height;
    return {wrong / std::max(1.0, math::hypot(centre.x, centre.y)) / sight.tolerance, true, 0};
  }
  const Vector3 p = centre - sight.eye;
  const double far = std::max(length(p), 1e-9);
  const Vector3 d = (1 / far) * p;
  // Seen through the flat triangle? Then only the depth is wrong.
  const Vector3 e[3] = {a - sight.eye, b - sight.eye, c - sight.eye};
  const double s0 = dot(cross(e[0], e[1]), d), s1 = dot(cross(e[1], e[2]), d), s2 = dot(cross(e[2], e[0]), d);
  const bool through = (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
  double seen = 0;
  if (!through) {
    seen = height / far;
    for (int i = 0; i < 3; ++i) {
      const double side = seen_from(d, e[i], e[(i + 1) % 3]);
      if (side >= 0) seen = std::min(seen, side);
    }
  }
  double angle = std::max(seen, height / far);
  if (along > 0) angle = std::max(angle, across(d, off) / far / along);
  const Vector3 points[4] = {e[0], e[1], e[2], p};
  return in_frame(sight, angle, pixels_at(sight, d), points, 4);
}

}  // namespace orbc::bend
