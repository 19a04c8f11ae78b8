#pragma once
#include "compiler/render/draw.h"
#include "compiler/render/indirect.h"

namespace orbc::render {

/// What one ray of the eye finds.
struct RayResult {
  scene::Color radiance;
  scene::Color indirect;     ///< the part of it that is indirect light (`integrator: path`): a random estimate, unlike the rest
  trace::Path path;          ///< to the first surface that is no mirror of the room
  bool hit = false;
  trace::SurfacePoint surface;  ///< that surface, if hit
};

/// The part of a ray's radiance that pictures show, and an upper bound of the mean of that over samples. Radiance is cut off at white
/// sample by sample, as renderers of exports do, so that edges of what is brighter are smooth; but random estimates are not, whose mean
/// would become too dark: only their mean is bounded.
struct ShownRadiance {
  scene::Color radiance, bound;
};
[[nodiscard]] ShownRadiance shown_radiance(const RayResult& result, double white);

/// The radiance along a ray. In scenes without lamps it is the albedo of what the ray hits; else its light, with one estimate of the
/// indirect light for `integrator: path`. Mirror, glass and metal objects are followed up to DrawOptions::max_depth.
[[nodiscard]] RayResult radiance(const trace::TraceScene& scene, const trace::Ray& ray, const DrawOptions& options,
                                 const PixelSampler& sampler = {});
/// The same for a ray that was already followed with `follow_options`.
[[nodiscard]] RayResult radiance(const trace::TraceScene& scene, trace::Path path, const DrawOptions& options,
                                 const PixelSampler& sampler = {});
[[nodiscard]] trace::FollowOptions follow_options(const DrawOptions& options);

}  // namespace orbc::render
