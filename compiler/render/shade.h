#pragma once
#include "compiler/render/draw.h"

namespace orbc::render {

/// What one ray brings back.
struct Seen {
  scene::Color radiance;
  trace::Path path;                 ///< to the first surface that is not a mirror on a wall
  bool hit = false;
  trace::SurfacePoint surface;      ///< there, if hit
};

/// Radiance along a ray: plain colours in scenes without lamps, else their light (DrawOptions::light); mirrors and glass among the objects followed to `max_depth`.
[[nodiscard]] Seen radiance(const trace::TraceScene& scene, const trace::Ray& ray, const DrawOptions& options);

/// The colour of a surface point without any light: flat, checker cell, or texel (nearest) times colour.
[[nodiscard]] scene::Color surface_color(const place::PlacedRoom& room, const trace::SurfacePoint& point);

}  // namespace orbc::render
