#include <catch2/catch.hpp>

#include "compiler/light/albedo.h"
#include "compiler/light/bake.h"
#include "compiler/light/leg.h"
#include "compiler/notation/parse.h"
#include "compiler/place/furnish.h"
#include "compiler/room/realise.h"
#include "compiler/scene/defaults.h"

using namespace orbc;

TEST_CASE("floor, ceiling and walls are cut from one stone, the same for a triangle as for a ray", "[light]") {
  scene::Scene scene = scene::default_scene(notation::parse(GENERATE("*222", "*333", "*22222")).value());
  scene::Material marble;
  marble.pattern = scene::Pattern::marble;
  marble.color = {0.9, 0.9, 0.9}, marble.second = {0.1, 0.1, 0.2};
  scene.room.floor.material = scene.room.ceiling.material = marble;
  scene.room.walls[0].material = marble;
  scene.room.walls[0].mirrors.clear();
  const place::PlacedRoom room = place::furnish(scene, room::realise(scene.orbifold, scene.room.shape).value()).value().room;
  CHECK(light::needs_bake(scene, room));
  int compared = 0, veins = 0;
  for (std::size_t p = 0; p < room.parts.size(); ++p) {
    const place::PlacedMesh& part = room.parts[p];
    if (room.looks[part.look[0]].material.pattern != scene::Pattern::marble) continue;
    for (std::size_t t = 0; t < part.triangles.size(); ++t)
      for (const std::array<double, 3>& b : {std::array<double, 3>{0.2, 0.3, 0.5}, {0.7, 0.1, 0.2}, {0.05, 0.9, 0.05}}) {
        trace::SurfacePoint point;
        geometry::Ambient sum{0, 0, 0};
        for (std::size_t k = 0; k < 3; ++k)
          sum = sum + b[k] * part.floor[part.triangles[t][k]], point.at.z += b[k] * part.z[part.triangles[t][k]];
        point.at.floor = geometry::normalised_point(room.room.space, sum);
        point.part = static_cast<int>(p), point.look = part.look[t];
        const scene::Color here = light::triangle_albedo(room, part, t, b), there = light::surface_color(room, point);
        CHECK(here.g == Approx(there.g).margin(1e-12));
        veins += here.g < 0.6;
        ++compared;
      }
  }
  CHECK(compared >= 3 * 8);
  CHECK(veins < compared);
}
