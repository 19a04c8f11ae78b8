// The white point. Light adds up linearly, so to divide every source by it is to divide the picture by it, up to the limit of what a
// surface can show; and all outputs agree, since none of them knows. Luminance: Rec. 709.
#include <algorithm>

#include "compiler/scene/parts.h"

namespace orbc::scene {
namespace {

Color divided(const Color& c, const Color& by) { return {c.r / by.r, c.g / by.g, c.b / by.b}; }

// What glows by itself is a light too, and so is a scene whose surfaces pass light on.
bool has_light(const Scene& scene) {
  const auto glows = [](const Material& material) { return material.kind == MaterialKind::emissive; };
  const auto mirror_glows = [&](const Mirror& mirror) {
    return !(mirror.glow == Color{}) || (mirror.frame && glows(mirror.frame->material));
  };
  const auto surface_glows = [&](const Surface& surface) {
    return glows(surface.material) || (surface.mirror && mirror_glows(*surface.mirror));
  };
  return !scene.lamps.empty() || scene.integrator == Integrator::path || surface_glows(scene.room.floor) ||
         surface_glows(scene.room.ceiling) ||
         std::any_of(scene.objects.begin(), scene.objects.end(),
                     [&](const Object& object) { return object.material && glows(*object.material); }) ||
         std::any_of(scene.room.walls.begin(), scene.room.walls.end(), [&](const Wall& wall) {
           return glows(wall.material) || std::any_of(wall.mirrors.begin(), wall.mirrors.end(), mirror_glows);
         });
}

void balance(Material& material, const Color& white) {
  if (material.kind != MaterialKind::emissive) return;
  material.color = divided(material.color, white);
  material.second = divided(material.second, white);
}

void balance(Mirror& mirror, const Color& white) {
  mirror.glow = divided(mirror.glow, white);
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
  // Light that shall look white has some of every colour: a hundredth at least.
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
