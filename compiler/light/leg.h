#pragma once
#include "compiler/light/random.h"
#include "compiler/light/shade.h"

namespace orbc::light {

/// The colour of a surface point without any light: surface_albedo where a ray has ended.
[[nodiscard]] scene::Color surface_color(const place::PlacedRoom& room, const trace::SurfacePoint& point);

/// The direction of the ray that a mirror object sends back from a point of it.
[[nodiscard]] trace::Direction mirrored(const trace::TraceScene& scene, const trace::SurfacePoint& point);
/// Glass: the share of light that is sent back, and the direction of the rest.
struct Refraction {
  double reflectance = 1;
  trace::Direction direction;
};
/// Formula: Snell; Fresnel for unpolarised light (Born & Wolf, Principles of Optics, §1.5); 1 at total reflection.
[[nodiscard]] Refraction refracted(const trace::TraceScene& scene, const trace::SurfacePoint& point, double index);

/// A leg of a walk of light: a ray through the room's mirrors, and on through mirror and glass objects, to the next matte surface.
struct Leg {
  const place::PlacedRoom& room;    ///< with its textures
  const LightField& field;
  Random& random;                   ///< chooses at glass between sent back and let through
  scene::Color sum;                 ///< what came up on the way: mirrors that glow, emissive surfaces, the background where it is cut off
  scene::Color weight{1, 1, 1};
  trace::SurfacePoint point;        ///< its end, if it arrives
  trace::Hit hit;

  [[nodiscard]] trace::FollowOptions follow_options() const;
  bool arrive(const trace::Ray& ray);
  /// In: the ray, already followed with follow_options().
  bool arrive(trace::Path path);
};

}  // namespace orbc::light
