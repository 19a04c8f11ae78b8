#include "compiler/surface/albedo.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "compiler/notation/parse.h"
#include "compiler/place/furnish.h"
#include "compiler/room/realise.h"
#include "compiler/scene/defaults.h"

using namespace orbc;

TEST_CASE("floor, ceiling and walls are cut from one stone, the same for a triangle as for a ray", "[surface]") {
  scene::Scene scene = scene::default_scene(notation::parse(GENERATE("*222", "*333", "*22222")).value());
  scene::Material marble;
  marble.pattern = scene::Pattern::marble;
  marble.color = {0.9, 0.9, 0.9}, marble.second = {0.1, 0.1, 0.2};
  scene.room.floor.material = scene.room.ceiling.material = marble;
  scene.room.walls[0].material = marble;
  scene.room.walls[0].mirrors.clear();
  const place::Interior room = place::furnish(scene, room::realise(scene.orbifold, scene.room.shape).value()).value().interior;
  int compared = 0, veins = 0;
  for (std::size_t p = 0; p < room.parts.size(); ++p) {
    const place::PlacedMesh& part = room.parts[p];
    if (room.styles[part.style[0]].material.pattern != scene::Pattern::marble) continue;
    for (std::size_t t = 0; t < part.triangles.size(); ++t)
      for (const std::array<double, 3>& b : {std::array<double, 3>{0.2, 0.3, 0.5}, {0.7, 0.1, 0.2}, {0.05, 0.9, 0.05}}) {
        trace::SurfacePoint point;
        geometry::Ambient sum{0, 0, 0};
        for (std::size_t k = 0; k < 3; ++k)
          sum = sum + b[k] * part.floor[part.triangles[t][k]], point.at.z += b[k] * part.z[part.triangles[t][k]];
        point.at.floor = geometry::normalised_point(room.polygon.space, sum);
        point.part = static_cast<int>(p), point.style = part.style[t];
        const scene::Color here = surface::triangle_albedo(room, part, t, b), there = surface::hit_albedo(room, point);
        CHECK(here.g == Approx(there.g).margin(1e-12));
        veins += here.g < 0.6;
        ++compared;
      }
  }
  CHECK(compared >= 3 * 8);
  CHECK(veins < compared);
}

TEST_CASE("solid patterns are the same stone everywhere and stay between their colours", "[surface]") {
  CHECK(surface::solid_pattern(scene::Pattern::granite, {0.1, 0.2, 0.3}, 0.2) ==
        surface::solid_pattern(scene::Pattern::granite, {0.1, 0.2, 0.3}, 0.2));
  for (const scene::Pattern pattern : {scene::Pattern::marble, scene::Pattern::wood, scene::Pattern::granite}) {
    double low = 1, high = 0, jump = 0, last = 0;
    for (int i = 0; i < 4000; ++i) {
      const double t = surface::solid_pattern(pattern, {i * 0.0005, 0.3 - i * 0.0002, i * 0.0001}, 0.25);
      low = std::min(low, t), high = std::max(high, t);
      if (i > 0) jump = std::max(jump, std::fabs(t - last));
      last = t;
    }
    CHECK(low >= 0);
    CHECK(high <= 1);
    CHECK(high - low > 0.5);
    CHECK(jump < 0.3);
  }
}
