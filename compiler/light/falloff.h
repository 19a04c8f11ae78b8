#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/geometry/space.h"
#include "compiler/scene/scene.h"

namespace orbc::light {

/// How much of the power of a lamp that shines alike to all sides falls on a unit of area across the path, for power 1.
/// In:      path length L > 0, its horizontal part s = L·cosα (α the slope), the lamp's radius.
/// Formula: cosα/(4π·L·|sinκ(L·cosα)|). Why: the directions at the lamp with slope in dα and azimuth in dφ fill the solid angle dΩ = cosα
///          dα dφ. All geodesics of one azimuth lie in a vertical strip (floor geodesic × height), which is flat: at path length L those of
///          dα are L·dα apart. Across the strip two floor geodesics of dφ are |sinκ(s)|·dφ apart after the arc s. So power dΩ/4π crosses
///          the area L·|sinκ(s)|·dα·dφ. κ = 0: 1/(4πL²).
/// Clamped: inside the lamp at its radius, and near the focus on S² (s = π, 2π, …) where geodesics meet again, at the lamp's radius too:
///          there a lamp of that radius has an image of its own size.
[[nodiscard]] inline double geodesic_falloff(geometry::Space space, double length, double arc, double radius) {
  const double l = std::max(length, radius), s = std::fabs(arc);
  // s/|sinκ s| is 1 near the lamp; written so, nothing divides by a small arc.
  double spread = 1;
  if (s > 1e-6) {
    const double least = s > 1 ? geometry::sin_k(space, std::min(radius, 1.0)) : 0;
    spread = s / std::max(std::fabs(geometry::sin_k(space, s)), least);
  }
  return spread / (4 * std::numbers::pi * l * l);
}

/// The same by the lamp's kind of falloff; `none` gives 1/4π at any distance.
[[nodiscard]] inline double falloff(scene::Falloff kind, geometry::Space space, double length, double arc, double radius) {
  switch (kind) {
    case scene::Falloff::geodesic: return geodesic_falloff(space, length, arc, radius);
    case scene::Falloff::inverse_square: return geodesic_falloff(geometry::Space::euclidean, length, arc, radius);
    case scene::Falloff::none: break;
  }
  return 1 / (4 * std::numbers::pi);
}

}  // namespace orbc::light
