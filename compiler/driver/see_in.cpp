#include "compiler/driver/see_in.h"

#include <algorithm>
#include <cstring>
#include <memory>

#include "compiler/driver/trace.h"
#include "compiler/light/random.h"
#include "compiler/light/shade.h"
#include "compiler/render/shade.h"

namespace orbc::driver {
namespace {

constexpr double kBack = 0.005;   // of the room's height: farther than coarser levels, which are chosen for less than a pixel, lie beside the surface

struct Looking {
  orbc::trace::TraceScene scene;
  light::LightField light;
  render::DrawOptions draw;
  double exposure = 1;
};

std::uint64_t bits_of(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

// One sees the surface again from a step back towards the eye: the ray meets it as the eye's own does.
orbc::trace::Ray looking_at(const orbc::trace::TraceScene& scene, const geometry::Position& at, const orbc::trace::Direction& to_eye) {
  const geometry::Space space = scene.prism.space;
  orbc::trace::Ray back = ray_from(space, at, to_eye);
  back.t_min = orbc::trace::kLeave;
  const orbc::trace::Hit hit = closest(scene, back);
  double step = kBack * scene.room->height;
  if (hit.target != orbc::trace::Target::triangle) step = std::min(step, hit.t / 2);   // never out of the room
  return ray_from(space, position_at(space, back, step), -direction_at(space, back, step));
}

}  // namespace

light::SeenIn see_in(const Opened& opened, const Executor& executor) {
  const auto looking = std::make_shared<Looking>();
  looking->scene = orbc::trace::prepare(*opened.room, executor);
  looking->light = light::prepare_light(opened.scene, *opened.room, light::light_options(opened.scene), executor).value();
  looking->draw = draw_options(opened, looking->light, executor);
  looking->exposure = looking->light.lit ? opened.scene.exposure : 1;
  return [looking](const geometry::Position& at, const orbc::trace::Direction& to_eye, const cover::Copy& copy) {
    orbc::trace::FollowOptions follow = render::follow_options(looking->draw);
    follow.bounces = copy.bounces;
    follow.weight = copy.weight;
    const light::Random random(bits_of(at.floor.x) ^ light::mixed(bits_of(at.floor.y)), bits_of(at.z), 0);
    const orbc::trace::Path path = orbc::trace::follow(looking->scene, looking_at(looking->scene, at, to_eye), follow);
    const scene::Color c = looking->exposure * render::radiance(looking->scene, path, looking->draw, random).radiance;
    const auto without = [](double shown, double weight) { return weight > 0 ? shown / weight : 0; };
    return scene::Color{without(c.r, copy.weight.r), without(c.g, copy.weight.g), without(c.b, copy.weight.b)};
  };
}

}  // namespace orbc::driver
