#include "compiler/driver/specular_query.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "compiler/bake/baked_light.h"
#include "compiler/driver/trace_film.h"
#include "compiler/render/radiance.h"

namespace orbc::driver {
namespace {

// Of the room's height: how far before a surface rays start. Rounding reaches less far, and hardly anything stands between.
constexpr double kStartDistance = 0.005;
constexpr int kDraftSpecularSamples = 32, kNormalSpecularSamples = 128;

/// What all queries share.
struct SpecularTracer {
  const trace::TraceScene& tracer;
  render::DrawOptions draw;
  std::optional<bake::BakedLight> baked;
  double exposure = 1;
};

/// A ray onto the surface at a point, as the eye's own ray meets it. It starts a step away from the surface, towards the eye.
/// In: `surface_offset`: how far the point may lie beside the surface.
trace::Ray ray_onto(const trace::TraceScene& tracer, const geometry::Position& at, const trace::Direction& to_eye, double surface_offset) {
  const geometry::Space space = tracer.prism.space;
  trace::Ray towards_eye = ray_from(space, at, to_eye);
  towards_eye.t_min = trace::kRayEpsilon;
  const trace::Hit hit = closest(tracer, towards_eye);
  double step = std::max(kStartDistance * tracer.interior->height, 2 * surface_offset);
  if (hit.kind != trace::HitKind::triangle) {
    step = std::min(step, hit.t / 2);  // never out of the room
  } else if (!surface_at(tracer, towards_eye, hit).front_facing) {
    // The point lies inside of a body: the ray starts outside of it, but not inside of the next.
    towards_eye.t_min = hit.t + trace::kRayEpsilon;
    step = std::max(step, hit.t + std::min(kStartDistance * tracer.interior->height, (closest(tracer, towards_eye).t - hit.t) / 2));
  }
  return ray_from(space, position_at(space, towards_eye, step), -direction_at(space, towards_eye, step));
}

double without_weight(double radiance, double weight) { return weight > 0 ? radiance / weight : 0; }

}  // namespace

bake::SpecularQuery specular_query(const PreparedScene& scene, const place::Camera& eye, const bake::DiffuseBake* baked, const Run& run) {
  const TraceContext& context = scene.trace_context(run);
  const auto shared =
      std::make_shared<SpecularTracer>(SpecularTracer{context.tracer, draw_options(scene, eye, run), std::nullopt, scene.scene().exposure});
  if (scene.scene().bake.quality != scene::BakeQuality::fine)
    shared->draw.specular_samples =
        scene.scene().bake.quality == scene::BakeQuality::draft ? kDraftSpecularSamples : kNormalSpecularSamples;
  if (baked && context.lighting.lit) shared->draw.baked = &shared->baked.emplace(scene.interior(), *baked);
  return [shared](const geometry::Position& at, const trace::Direction& to_eye, const cover::Copy& copy, double surface_offset,
                  const light::SampleStratum& stratum) {
    trace::FollowOptions follow = render::follow_options(shared->draw);
    follow.bounces = copy.bounces;
    follow.throughput = copy.weight;
    render::PixelSampler sampler;
    sampler.stratum = stratum;
    const trace::Path path = trace::follow(shared->tracer, ray_onto(shared->tracer, at, to_eye, surface_offset), follow);
    const scene::Color c = shared->exposure * render::radiance(shared->tracer, path, shared->draw, sampler).radiance;
    return scene::Color{without_weight(c.r, copy.weight.r), without_weight(c.g, copy.weight.g), without_weight(c.b, copy.weight.b)};
  };
}

}  // namespace orbc::driver
