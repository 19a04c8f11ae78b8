#pragma once
#include "compiler/render/draw.h"
#include "compiler/render/indirect.h"

namespace orbc::render {

/// What one ray of the eye finds.
struct RayResult {
  scene::Color radiance;
  scene::Color indirect;     ///< the part of it that is indirect light (`integrator: path`): a random estimate, unlike the rest
  scene::Color white_bound;  ///< upper bound of the mean over samples: white, times the throughput of the mirrors
  trace::Path path;          ///< to the first surface that is no mirror of the room
  bool hit = false;
  trace::SurfacePoint surface;  ///< that surface, if hit
};

/// The radiance along a ray. In scenes without lamps it is the albedo of what the ray hits; else its light, with one estimate of the
/// indirect light for `integrator: path`. Mirror, glass and metal objects are followed up to DrawOptions::max_depth.
[[nodiscard]] RayResult radiance(const trace::TraceScene& scene, const trace::Ray& ray, const DrawOptions& options,
                                 const PixelSampler& sampler = {});
/// The same for a ray that was already followed with `follow_options`.
[[nodiscard]] RayResult radiance(const trace::TraceScene& scene, trace::Path path, const DrawOptions& options,
                                 const PixelSampler& sampler = {});
[[nodiscard]] trace::FollowOptions follow_options(const DrawOptions& options);

}  // namespace orbc::render
