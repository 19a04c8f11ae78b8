// A ray of slope m is at height eye_z + m·s after the arc length s, in every space. So it passes above a bound when m exceeds the slope of
// the bound.
#include "compiler/cover/height_bounds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"

namespace orbc::cover {
namespace {

using geometry::Space;

constexpr double kMaxArcLength = 18.5;         // H²: artanh of the largest double below 1
constexpr double kMissedWallArcLength = 1e12;  // E²: of a bearing that misses the wall by rounding
constexpr double kRelativeSlopeMargin = 0.05;  // slopes change by less of their size between two sampled bearings
constexpr int kBearingCount = 33;

/// Whether slope(a) ≥ slope(b) for every bearing. In: heights above the eye; `a_first`: rays meet a before b.
bool is_steeper_everywhere(double a, double b, bool a_first) {
  if (a >= 0 && b <= 0) return true;
  if (a < b) return false;
  return a >= 0 ? a_first : !a_first;
}

}  // namespace

double distance_to(Space space, const HeightBound& bound, const Bearing& bearing) {
  const double q = bound.line.x * bearing.x + bound.line.y * bearing.y, w = -bound.line.w;
  if (space == Space::spherical) {
    const double s = math::atan2(w < 0 ? -w : w, w < 0 ? -q : q);
    return std::max(s + bound.sheet * std::numbers::pi, 1e-12);
  }
  if (space == Space::euclidean) return q * w > 0 ? w / q : kMissedWallArcLength;
  const double t = q * w > 0 ? w / q : 1;
  return t < 1 ? std::min(math::atanh(t), kMaxArcLength) : kMaxArcLength;
}

std::vector<Bearing> sample_bearings(const Wedge& wedge, int count) {
  const double angle = math::atan2(cross(wedge.from, wedge.to), wedge.from.x * wedge.to.x + wedge.from.y * wedge.to.y);
  std::vector<Bearing> bearings{wedge.from};
  for (int i = 1; i + 1 < count; ++i) {
    const double c = math::cos(angle * i / (count - 1)), s = math::sin(angle * i / (count - 1));
    bearings.push_back({wedge.from.x * c - wedge.from.y * s, wedge.from.y * c + wedge.from.x * s});
  }
  bearings.push_back(wedge.to);
  return bearings;
}

std::vector<HeightBound> with_bound(std::vector<HeightBound> bounds, const HeightBound& next, double eye_z) {
  // Of two bounds that rays pass above, the steeper one implies the other; of two that rays pass below, the less steep one.
  const auto implies_next = [&](const HeightBound& known) {
    if (known.above != next.above) return false;
    return next.above ? is_steeper_everywhere(known.z - eye_z, next.z - eye_z, true)
                      : is_steeper_everywhere(next.z - eye_z, known.z - eye_z, false);
  };
  const auto is_implied = [&](const HeightBound& known) {
    if (known.above != next.above) return false;
    return next.above ? is_steeper_everywhere(next.z - eye_z, known.z - eye_z, false)
                      : is_steeper_everywhere(known.z - eye_z, next.z - eye_z, true);
  };
  if (std::any_of(bounds.begin(), bounds.end(), implies_next)) return bounds;
  bounds.erase(std::remove_if(bounds.begin(), bounds.end(), is_implied), bounds.end());
  bounds.push_back(next);
  return bounds;
}

bool is_blocked(Space space, const std::vector<HeightBound>& bounds, const HeightRange& range, const Wedge& wedge, double eye_z) {
  for (const Bearing& bearing : sample_bearings(wedge, kBearingCount)) {
    double lowest = slope_of(space, range.low, bearing, eye_z), highest = slope_of(space, range.high, bearing, eye_z);
    for (const HeightBound& bound : bounds) {
      const double slope = slope_of(space, bound, bearing, eye_z);
      if (bound.above) lowest = std::max(lowest, slope);
      else highest = std::min(highest, slope);
    }
    if (lowest < highest + kRelativeSlopeMargin * (std::fabs(lowest) + std::fabs(highest))) return false;
  }
  return true;
}

}  // namespace orbc::cover
