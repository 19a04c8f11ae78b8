#include "compiler/scene/defaults.h"

#include "compiler/notation/euler.h"
#include "compiler/notation/growth.h"
#include "compiler/scene/check.h"

#include <algorithm>

namespace orbc::scene {

int wall_count(const notation::Orbifold& orbifold) {
  return orbifold.strip ? 4 : std::max<int>(1, static_cast<int>(orbifold.corners.size()));
}

int corner_count(const notation::Orbifold& orbifold) { return orbifold.strip ? 4 : static_cast<int>(orbifold.corners.size()); }

Surface default_floor() {
  Surface floor;
  floor.material.pattern = Pattern::checker;
  floor.material.color = from_hex(0xF2EBDD);   // ivory and slate: light enough to show colours that mirrors tint
  floor.material.second = from_hex(0x6E7F91);
  return floor;
}

Surface default_ceiling() {
  Surface ceiling;
  ceiling.material.color = from_hex(0xE6ECF2);
  return ceiling;
}

Wall default_wall(int number, bool strip) {
  Wall wall;
  wall.material.color = from_hex(0xC9B8A0);
  if (!strip || number % 2 == 1) wall.mirrors.emplace_back();
  return wall;
}

Frame default_frame() {
  Frame frame;
  frame.material.color = from_hex(0xB8862F);
  return frame;
}

int default_max_bounces(const notation::Orbifold& orbifold) {
  constexpr int kMost = 12, kCopies = 200;
  if (!notation::is_orbifold(orbifold) || curvature_sign(orbifold) >= 0) return kMost;
  int bounces = 1;
  while (bounces < kMost && notation::copies_up_to(orbifold, bounces + 1) <= kCopies) ++bounces;
  return bounces;
}

Scene default_scene(const notation::Orbifold& orbifold) {
  Scene scene;
  scene.orbifold = orbifold;
  scene.cover.max_bounces = default_max_bounces(orbifold);
  scene.room.floor = default_floor();
  scene.room.ceiling = default_ceiling();
  for (int i = 1; i <= wall_count(orbifold); ++i) scene.room.walls.push_back(default_wall(i, orbifold.strip));
  scene.camera.look_at.value = LookDirection{};
  return scene;
}

}  // namespace orbc::scene
