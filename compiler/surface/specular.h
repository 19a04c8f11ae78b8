#pragma once
#include "compiler/trace/follow.h"

namespace orbc::surface {

/// The direction in which a perfect mirror at a point reflects the ray that arrives there. Makes: a unit direction.
[[nodiscard]] trace::Direction reflect(geometry::Space space, const trace::SurfacePoint& point);

/// Light at the surface of glass.
struct Refraction {
  double reflectance = 1;      ///< the reflected share; 1 at total reflection
  trace::Direction direction;  ///< unit: that of the transmitted light; no meaning at total reflection
};
/// Refracts the ray that arrives at a point. In: the index of refraction of the glass; SurfacePoint::outside says on which side the ray is.
/// Formula: Snell's law; Fresnel's reflectance of unpolarised light (Born and Wolf, Principles of optics, §1.5).
[[nodiscard]] Refraction refract(geometry::Space space, const trace::SurfacePoint& point, double index);

}  // namespace orbc::surface
