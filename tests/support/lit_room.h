#pragma once
#include <string>
#include <utility>

#include "compiler/light/lighting.h"
#include "compiler/notation/parse.h"
#include "compiler/place/furnish.h"
#include "compiler/room/realise.h"
#include "compiler/scene/defaults.h"

namespace orbc::test {

/// The default room of an orbifold with one lamp.
inline scene::Scene lit_scene(const std::string& orbifold, scene::LampKind kind, bool mirrors) {
  scene::Scene scene = scene::default_scene(notation::parse(orbifold).value());
  for (scene::Wall& wall : scene.room.walls)
    if (!mirrors) wall.mirrors.clear();
  scene::Lamp lamp;
  lamp.kind = kind;
  lamp.place.floor = scene::AtPolar{0.1, Angle::from_degrees(20)};
  lamp.place.z = 0.6;
  scene.lamps = {lamp};
  return scene;
}

/// A room with its light.
struct LitRoom {
  scene::Scene scene;
  place::Interior interior;
  light::LightingContext lighting;
};

/// In: the most mirrors on a path from a lamp, and the most matte surfaces on a path of indirect light. No image of a lamp is left out.
inline LitRoom light_room(const scene::Scene& scene, int bounces, int indirect_bounces = 0) {
  LitRoom result{scene, place::furnish(scene, room::realise(scene.orbifold, scene.room.shape).value()).value().interior, {}};
  light::LightOptions options;
  options.bounces = bounces;
  options.indirect_bounces = indirect_bounces;
  options.cull_below = 0;
  result.lighting = light::prepare_light(result.scene, result.interior, options).value();
  return result;
}

}  // namespace orbc::test
