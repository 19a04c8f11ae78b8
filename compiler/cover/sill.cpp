// Slopes: a ray of slope m is at height eye_z + m·s after arc length s, whatever the space, so it passes above a sill when m exceeds the
// sill's slope.
#include "compiler/cover/sill.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"

namespace orbc::cover {
namespace {

using geometry::Space;

constexpr double kFarthest = 18.5;   // H²: artanh of the largest double below 1
constexpr double kMargin = 0.05;     // between the bearings looked at slopes change by less of their size
constexpr int kLooks = 33;

/// Whether slope(a) ≥ slope(b) for every bearing; `a_first`: a is crossed before b.
bool steeper(double a, double b, bool a_first) {
  if (a >= 0 && b <= 0) return true;
  if (a < b) return false;
  return a >= 0 ? a_first : !a_first;
}

}  // namespace

double distance_to(Space space, const Sill& sill, const Bearing& bearing) {
  const double q = sill.line.x * bearing.x + sill.line.y * bearing.y, w = -sill.line.w;
  if (space == Space::spherical) {
    const double s = math::atan2(w < 0 ? -w : w, w < 0 ? -q : q);
    return std::max(s + sill.sheet * std::numbers::pi, 1e-12);
  }
  if (space == Space::euclidean) return q * w > 0 ? w / q : 1e12;
  const double t = q * w > 0 ? w / q : 1;
  return t < 1 ? std::min(math::atanh(t), kFarthest) : kFarthest;
}

std::vector<Bearing> spread(const Wedge& wedge, int count) {
  const double angle = math::atan2(turn(wedge.from, wedge.to), wedge.from.x * wedge.to.x + wedge.from.y * wedge.to.y);
  std::vector<Bearing> bearings{wedge.from};
  for (int i = 1; i + 1 < count; ++i) {
    const double c = math::cos(angle * i / (count - 1)), s = math::sin(angle * i / (count - 1));
    bearings.push_back({wedge.from.x * c - wedge.from.y * s, wedge.from.y * c + wedge.from.x * s});
  }
  bearings.push_back(wedge.to);
  return bearings;
}

void narrow(std::vector<Sill>& sills, const Sill& next, double eye_z) {
  // Of two sills to be passed above, the less steep bounds nothing; below, the steeper.
  for (const Sill& known : sills) {
    if (known.above != next.above) continue;
    if (next.above ? steeper(known.z - eye_z, next.z - eye_z, true) : steeper(next.z - eye_z, known.z - eye_z, false)) return;
  }
  sills.erase(std::remove_if(sills.begin(), sills.end(),
                             [&](const Sill& known) {
                               if (known.above != next.above) return false;
                               return next.above ? steeper(next.z - eye_z, known.z - eye_z, false)
                                                 : steeper(known.z - eye_z, next.z - eye_z, true);
                             }),
              sills.end());
  sills.push_back(next);
}

bool nothing_passes(Space space, const std::vector<Sill>& sills, const Sill& low, const Sill& high, const Wedge& wedge, double eye_z) {
  for (const Bearing& bearing : spread(wedge, kLooks)) {
    double from = slope_of(space, low, bearing, eye_z), to = slope_of(space, high, bearing, eye_z);
    for (const Sill& sill : sills) {
      const double slope = slope_of(space, sill, bearing, eye_z);
      sill.above ? from = std::max(from, slope) : to = std::min(to, slope);
    }
    if (from < to + kMargin * (std::fabs(from) + std::fabs(to))) return false;
  }
  return true;
}

}  // namespace orbc::cover
