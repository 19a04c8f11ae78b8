#pragma once
#include "compiler/trace/follow.h"

namespace orbc::surface {

/// The direction of the ray that a mirror object sends back from a point of it.
[[nodiscard]] trace::Direction mirrored(const trace::TraceScene& scene, const trace::SurfacePoint& point);
/// Glass: the share of light that is sent back, and the direction of the rest.
struct Refraction {
  double reflectance = 1;
  trace::Direction direction;
};
/// Formula: Snell; Fresnel for unpolarised light (Born & Wolf, Principles of Optics, §1.5); 1 at total reflection.
[[nodiscard]] Refraction refracted(const trace::TraceScene& scene, const trace::SurfacePoint& point, double index);

}  // namespace orbc::surface
