#pragma once
#include "compiler/render/draw.h"
#include "compiler/render/path.h"

namespace orbc::render {

/// What one ray brings back.
struct Seen {
  scene::Color radiance;
  scene::Color passed_on;           ///< the part of it that surfaces passed on (`integrator: path`): a random guess, unlike the rest
  scene::Color most;                ///< a mean of samples never shows more: white, seen by way of the mirrors
  trace::Path path;                 ///< to the first surface that is not a mirror on a wall
  bool hit = false;
  trace::SurfacePoint surface;      ///< there, if hit
};

/// Radiance along a ray: plain colours in scenes without lamps, else their light (DrawOptions::light) and, with `integrator: path`, one
/// guess of what surfaces pass on to each other; mirrors and glass among the objects followed to `max_depth`.
[[nodiscard]] Seen radiance(const trace::TraceScene& scene, const trace::Ray& ray, const DrawOptions& options,
                            const Chance& chance = {});
/// The same for a ray that has been followed already, with the options of `follow_options`.
[[nodiscard]] Seen radiance(const trace::TraceScene& scene, trace::Path path, const DrawOptions& options,
                            const Chance& chance = {});
[[nodiscard]] trace::FollowOptions follow_options(const DrawOptions& options);

}  // namespace orbc::render
