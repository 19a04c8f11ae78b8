#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/geometry/space.h"
#include "compiler/scene/scene.h"

namespace orbc::light {

/// The irradiance on a surface across the path from an isotropic lamp of power 1.
/// In:      path length L > 0; its floor geodesic s = L·cosα, with the slope α; the lamp's radius.
/// Formula: s/(4π·L²·|sinκ s|), which is cosα/(4π·L·|sinκ(L·cosα)|). In E² it is 1/(4πL²).
/// Why:     The directions at the lamp with slope in dα and azimuth in dφ fill the solid angle dΩ = cosα dα dφ. All geodesics of
///          one azimuth lie in a flat vertical strip (floor geodesic × height), where those of dα are L·dα apart at length L. Across the
///          strip, floor geodesics of dφ are |sinκ(s)|·dφ apart. So the power dΩ/4π crosses the area L·|sinκ(s)|·dα·dφ.
/// Clamped: inside the lamp to the value at its radius. Near a focus on S² (s = π, 2π, …), where geodesics meet again, to the value at
///          the lamp's radius from the focus: there a lamp has an image of its own size.
[[nodiscard]] inline double geodesic_falloff(geometry::Space space, double length, double arc, double radius) {
  const double l = std::max(length, radius), s = std::fabs(arc);
  double spread = 1;  // s/|sinκ s|, which is 1 near the lamp
  if (s > 1e-6) {
    const double min_sine = s > 1 ? geometry::sin_k(space, std::min(radius, 1.0)) : 0;
    spread = s / std::max(std::fabs(geometry::sin_k(space, s)), min_sine);
  }
  return spread / (4 * std::numbers::pi * l * l);
}

/// The same for a kind of falloff: `inverse_square` is that of E² in all spaces, `none` gives 1/4π at any distance.
[[nodiscard]] inline double falloff(scene::Falloff kind, geometry::Space space, double length, double arc, double radius) {
  switch (kind) {
    case scene::Falloff::geodesic:
      return geodesic_falloff(space, length, arc, radius);
    case scene::Falloff::inverse_square:
      return geodesic_falloff(geometry::Space::euclidean, length, arc, radius);
    case scene::Falloff::none:
      break;
  }
  return 1 / (4 * std::numbers::pi);
}

}  // namespace orbc::light
