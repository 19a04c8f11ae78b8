// The white point. Light is linear, so dividing every light source by the white point divides the image by it. All products agree, because
// none of them depends on the white point. Luminance: Rec. 709.
#include <algorithm>

#include "compiler/scene/readers.h"

namespace orbc::scene {
namespace {

Color divided(const Color& c, const Color& by) { return {c.r / by.r, c.g / by.g, c.b / by.b}; }

// Whether the scene has lamps, emissive surfaces, or indirect light.
bool has_light(const Scene& scene) {
  const auto is_emissive = [](const Material& material) { return material.kind == MaterialKind::emissive; };
  const auto is_mirror_emissive = [&](const Mirror& mirror) {
    return !(mirror.emission == Color{}) || (mirror.frame && is_emissive(mirror.frame->material));
  };
  const auto is_surface_emissive = [&](const Surface& surface) {
    return is_emissive(surface.material) || (surface.mirror && is_mirror_emissive(*surface.mirror));
  };
  return !scene.lamps.empty() || scene.integrator == Integrator::path || is_surface_emissive(scene.room.floor) ||
         is_surface_emissive(scene.room.ceiling) ||
         std::any_of(scene.objects.begin(), scene.objects.end(),
                     [&](const Object& object) { return object.material && is_emissive(*object.material); }) ||
         std::any_of(scene.room.walls.begin(), scene.room.walls.end(), [&](const Wall& wall) {
           return is_emissive(wall.material) || std::any_of(wall.mirrors.begin(), wall.mirrors.end(), is_mirror_emissive);
         });
}

void balance(Material& material, const Color& white) {
  if (material.kind != MaterialKind::emissive) return;
  material.color = divided(material.color, white);
  material.second = divided(material.second, white);
}

void balance(Mirror& mirror, const Color& white) {
  mirror.emission = divided(mirror.emission, white);
  if (mirror.frame) balance(mirror.frame->material, white);
}

}  // namespace

void balance_white(const Fields& fields, Scene& scene) {
  const Node* node = fields.find("white");
  if (!node) return;
  Color white{1, 1, 1};
  if (node->kind == NodeKind::scalar && number_of(*node)) white = color_of_temperature(fields.number("white", 6500, {2000, 25000}));
  else white = fields.color("white", white);
  const double luminance = 0.2126 * white.r + 0.7152 * white.g + 0.0722 * white.b;
  // Each channel of the white point is at least a hundredth of its luminance, so that the division is bounded.
  for (double* channel : {&white.r, &white.g, &white.b}) *channel = std::max({*channel, 0.01 * luminance, 1e-6});
  white = (1 / std::max(luminance, 1e-6)) * white;
  if (!has_light(scene)) fields.no_effect("white", "there are no lights");
  for (Lamp& lamp : scene.lamps) lamp.color = divided(lamp.color, white);
  scene.ambient = divided(scene.ambient, white);
  for (Object& object : scene.objects)
    if (object.material) balance(*object.material, white);
  for (Surface* surface : {&scene.room.floor, &scene.room.ceiling}) {
    balance(surface->material, white);
    if (surface->mirror) balance(*surface->mirror, white);
  }
  for (Wall& wall : scene.room.walls) {
    balance(wall.material, white);
    for (Mirror& mirror : wall.mirrors) balance(mirror, white);
  }
}

}  // namespace orbc::scene
