#include "compiler/bend/edge_error.h"

#include <algorithm>
#include <cmath>

namespace orbc::bend {
namespace {

using geometry::Ambient;
using geometry::Vector3;

constexpr double kLongChord2 = 0.9;  // squared length from which a chord is compared with the curve at seven points, not at three

/// An upper bound of the chord's error, in tolerances, from the two ends alone. Half of it is a bound for triangles, too (Kℓ²/6 against
/// Kℓ²/8).
double cheap_bound(const TornMap& torn, const ScreenMetric& metric, double color_tolerance, const Corner& a, const Corner& b) {
  if (torn.map().view == View::disk || a.axis != Axis::none || b.axis != Axis::none) return kUnbounded;
  const Ambient d = a.v - b.v;
  // Not scaled back to the surface, v may be a little short on S²; in H² the Euclidean length is the larger one.
  const double l = 1.1 * std::sqrt(d.w * d.w + d.x * d.x + d.y * d.y), l2 = l * l;
  if (l > 0.5) return kUnbounded;
  const double from = std::max(0.0, (a.distance + b.distance - l) / 2), to = (a.distance + b.distance + l) / 2;
  const double k = acceleration_bound(torn.map(), from, to), rise = std::fabs(a.z - b.z);
  // How far the parameter is ahead of the arc length: by the curvature, and by unequal norms q: at most (√q − 1)/(√q + 1) ≤ (q − 1)/4.
  const double ahead = l2 / 50 + (std::max(a.norm, b.norm) / std::min(a.norm, b.norm) - 1) / 4;
  double off = k * l2 / 8 + ahead * rise;
  const Vector3 p = a.image - metric.eye, q = b.image - metric.eye;
  const double near = std::min(length(p), length(q)) - length(p - q) - off;
  if (!(near > 1e-6)) return kUnbounded;
  if (color_tolerance > 0) off = std::max(off, (k * l2 / 8 + ahead * (rise + l)) / color_tolerance);
  return off / near * max_pixels_per_radian(metric) / metric.tolerance;
}

}  // namespace

EdgeVerdict judge_edge(const TornMap& torn, const ScreenMetric& metric, double color_tolerance, const Corner& a, const Corner& b) {
  const double bound = cheap_bound(torn, metric, color_tolerance, a, b);
  if (bound <= 0.5) return {false, false, true, bound};
  const Ambient d = a.v - b.v;
  const std::size_t samples = d.w * d.w + d.x * d.x + d.y * d.y > kLongChord2 ? 7 : 3;
  const std::optional<double> bisection = torn.bisection(a, b);
  CurvePoint curve[8];
  const std::size_t count = samples + (bisection ? 1 : 0);
  for (std::size_t i = 0; i < count; ++i) {
    const double t = i == samples ? *bisection : (static_cast<double>(i) + 1) / (static_cast<double>(samples) + 1);
    curve[i] = {t, image_of(torn.map(), (1 - t) * a.v + t * b.v, (1 - t) * a.z + t * b.z)};
  }
  const Vector3 first = torn.image_towards(a, b), last = torn.image_towards(b, a);
  const ChordError error = measure_chord(metric, first, last, {curve, count}, color_tolerance);
  if (error.tolerances > 1) return {true, error.worst_point == samples, false, 0};
  return {false, false, false, error.in_picture ? error.tolerances : 0};
}

ChordError triangle_error(const TornMap& torn, const ScreenMetric& metric, double color_tolerance,
                          const std::array<const Corner*, 3>& corners) {
  const Corner &a = *corners[0], &b = *corners[1], &c = *corners[2];
  // The image of a horizontal triangle is horizontal: only its edges can be off, unless colours shift.
  if (torn.map().log.space == geometry::Space::euclidean || (a.z == b.z && b.z == c.z && color_tolerance == 0)) return {0, false, 0};
  const Vector3 centre = image_of(torn.map(), (1.0 / 3) * (a.v + b.v + c.v), (a.z + b.z + c.z) / 3);
  return measure_centre(metric, {a.image, b.image, c.image}, centre, color_tolerance);
}

}  // namespace orbc::bend
