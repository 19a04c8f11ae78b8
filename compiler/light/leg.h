#pragma once
#include "compiler/light/shade.h"
#include "compiler/surface/albedo.h"
#include "compiler/surface/random.h"
#include "compiler/surface/specular.h"

namespace orbc::light {

/// A leg of a walk of light: a ray through the room's mirrors, and on through mirror and glass objects, to the next matte surface.
struct Leg {
  const place::PlacedRoom& room;  ///< with its textures
  const LightField& field;
  surface::Random& random;  ///< chooses at glass between sent back and let through
  scene::Color sum;         ///< what came up on the way: mirrors that glow, emissive surfaces, the background where it is cut off
  scene::Color weight{1, 1, 1};
  trace::SurfacePoint point;  ///< its end, if it arrives
  trace::Hit hit;

  [[nodiscard]] trace::FollowOptions follow_options() const;
  bool arrive(const trace::Ray& ray);
  /// In: the ray, already followed with follow_options().
  bool arrive(trace::Path path);
};

}  // namespace orbc::light
