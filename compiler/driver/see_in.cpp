#include "compiler/driver/see_in.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "compiler/bake/baked_light.h"
#include "compiler/driver/prepared.h"
#include "compiler/driver/trace.h"
#include "compiler/render/radiance.h"

namespace orbc::driver {
namespace {

constexpr double kBack = 0.005;  // of the room's height: farther than rounding reaches, and nearer than anything may stand in between

struct Looking {
  const orbc::trace::TraceScene& scene;
  const light::LightingContext& light;
  render::DrawOptions draw;
  std::optional<bake::BakedLight> baked;
  double exposure = 1;
};

// One sees the surface again from a step back towards the eye: the ray meets it as the eye's own does.
orbc::trace::Ray looking_at(const orbc::trace::TraceScene& scene, const geometry::Position& at, const orbc::trace::Direction& to_eye,
                            double beside) {
  const geometry::Space space = scene.prism.space;
  orbc::trace::Ray back = ray_from(space, at, to_eye);
  back.t_min = orbc::trace::kRayEpsilon;
  const orbc::trace::Hit hit = closest(scene, back);
  double step = std::max(kBack * scene.interior->height, 2 * beside);
  if (hit.kind != orbc::trace::HitKind::triangle) step = std::min(step, hit.t / 2);  // never out of the room
  else if (!surface_at(scene, back, hit).front_facing) {  // out of the body first, but not into what stands there
    back.t_min = hit.t + orbc::trace::kRayEpsilon;
    step = std::max(step, hit.t + std::min(kBack * scene.interior->height, (closest(scene, back).t - hit.t) / 2));
  }
  return ray_from(space, position_at(space, back, step), -direction_at(space, back, step));
}

}  // namespace

bake::SpecularQuery see_in(const Opened& opened, const bake::DiffuseBake* baked, const Executor& executor) {
  const Prepared& ready = prepared(opened, executor);
  const auto looking = std::make_shared<Looking>(
      Looking{ready.scene, ready.light, draw_options(opened, ready.light, executor), std::nullopt, opened.scene.exposure});
  if (opened.scene.bake.quality != scene::BakeQuality::fine)
    looking->draw.specular_samples = opened.scene.bake.quality == scene::BakeQuality::draft ? 32 : 128;
  if (baked && ready.light.lit) looking->draw.baked = &looking->baked.emplace(*opened.room, *baked);
  return [looking](const geometry::Position& at, const orbc::trace::Direction& to_eye, const cover::Copy& copy, double beside,
                   const light::SampleStratum& stratum) {
    orbc::trace::FollowOptions follow = render::follow_options(looking->draw);
    follow.bounces = copy.bounces;
    follow.throughput = copy.weight;
    render::PixelSampler sampler;
    sampler.stratum = stratum;
    const orbc::trace::Path path = orbc::trace::follow(looking->scene, looking_at(looking->scene, at, to_eye, beside), follow);
    const scene::Color c = looking->exposure * render::radiance(looking->scene, path, looking->draw, sampler).radiance;
    const auto without = [](double shown, double weight) { return weight > 0 ? shown / weight : 0; };
    return scene::Color{without(c.r, copy.weight.r), without(c.g, copy.weight.g), without(c.b, copy.weight.b)};
  };
}

}  // namespace orbc::driver
