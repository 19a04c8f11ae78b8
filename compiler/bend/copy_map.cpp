#include "compiler/bend/copy_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/bend/screen_metric.h"

namespace orbc::bend {

using geometry::Ambient;
using geometry::Space;

geometry::Vector3 image_of(const CopyMap& map, const Ambient& v, double z) {
  const geometry::Point p = geometry::normalised_point(map.log.space, v);
  if (map.view == View::eye) return bent_position(map.log, p, z);
  const Ambient q = map.log.eye_from_copy * p;
  if (map.log.space == Space::euclidean) return {q.x, q.y, z};
  const double scale = map.chart_scale / std::max(1 + q.w, 1e-12);
  return {q.x * scale, q.y * scale, z};
}

double acceleration_bound(const CopyMap& map, double from, double to) {
  if (map.log.space == Space::euclidean) return 0;
  if (map.log.space == Space::hyperbolic) return math::hypot(std::min(1.0, 2 * to / 3), std::min(0.32, to / 3));
  if (map.log.sheet == 0 && to <= std::numbers::pi / 2) return to * math::hypot(1, 0.64);
  const bool torn_at_foot = map.log.sheet > 0;
  constexpr double kNearAxis = 1e-3;  // radians
  if (to > std::numbers::pi - kNearAxis || (torn_at_foot && from < kNearAxis)) return kUnbounded;
  // The sine is smallest at one of the ends.
  const double s = torn_at_foot ? std::min(math::sin(from), math::sin(to)) : math::sin(to);
  const double largest = torn_at_foot ? (map.log.sheet + 1) * std::numbers::pi : to;
  return math::hypot(0.5 + largest, 1 + largest) / (s * s);
}

}  // namespace orbc::bend
