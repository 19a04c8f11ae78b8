#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "compiler/bake/diffuse.h"
#include "compiler/geometry/point.h"
#include "compiler/light/connection.h"
#include "compiler/surface/tangent_frame.h"
#include "tests/support/lit_room.h"

using namespace orbc;
using test::LitRoom;

namespace {

LitRoom lit(const std::string& orbifold, int indirect_bounces = 0) {
  scene::Scene scene = test::lit_scene(orbifold, scene::Lamp{}.kind, true);
  scene.objects.resize(1);
  scene.objects[0].shape = scene::CylinderSpec{0.05, 0.2};
  scene.objects[0].place.floor = scene::AtPolar{0.1, Angle::from_degrees(200)};
  for (scene::Wall& wall : scene.room.walls) wall.mirrors.front().frame = scene::Frame{0.035, {}};
  return test::light_room(scene, 2, indirect_bounces);
}

}  // namespace

TEST_CASE("a point of a coarser level is lit as the surface just there, not as its far side", "[bake]") {
  const LitRoom l = lit(GENERATE("*222", "*333", "*22222"));
  const geometry::Space space = l.interior.polygon.space;
  std::size_t sides = 0;
  for (std::size_t p = 0; p < l.interior.parts.size(); ++p) {
    const place::PlacedMesh& part = l.interior.parts[p];
    if (part.kind != place::PartKind::object || light::lamp_of_part(part) >= 0) continue;
    for (std::size_t t = 0; t < part.triangles.size(); ++t) {
      const surface::ShadingPoint on = surface::shading_point(l.interior, part, l.lighting.normals[p], t, {0.3, 0.5, 0.2});
      // Long patches reach beyond the other side; and normals of a level are not quite those of the part.
      surface::ShadingPoint turned = on;
      turned.normal = on.geometric_normal;
      const surface::ShadingPoint there = light::project_to_surface(l.lighting, turned, 0.15).point;
      CHECK(trace::inner(space, there.normal, on.normal) == Approx(1).margin(1e-6));
      CHECK(geometry::distance(space, there.at.floor, on.at.floor) + std::fabs(there.at.z - on.at.z) < 1e-6);
      ++sides;
    }
  }
  CHECK(sides > 100);
}

TEST_CASE("a level that is the part itself has its light", "[bake]") {
  const int passes = GENERATE(0, 6);
  const LitRoom l = lit(GENERATE("*222", "*333", "*22222"), passes);
  const auto is_cylinder = [](const place::PlacedMesh& part) {
    return part.kind == place::PartKind::object && light::lamp_of_part(part) < 0;
  };
  const auto p =
      static_cast<std::size_t>(std::find_if(l.interior.parts.begin(), l.interior.parts.end(), is_cylinder) - l.interior.parts.begin());
  place::Interior both = l.interior;
  both.parts.push_back(l.interior.parts[p]);
  scene::BakeSpec draft;
  draft.quality = scene::BakeQuality::draft;
  const bake::DiffuseBake baked = bake::bake_diffuse(both, l.lighting, bake::bake_options(draft), serial_executor()).value();
  const auto green = [&](const bake::TexelRect& rect, double u, double v) {
    const int x = rect.x + static_cast<int>(std::lround(u * (rect.width - 1))),
              y = rect.y + static_cast<int>(std::lround(v * (rect.height - 1)));
    return static_cast<int>(baked.atlas.image.rgba[4 * static_cast<std::size_t>(y * baked.atlas.image.width + x) + 1]);
  };
  REQUIRE(baked.rects.back().size() == baked.rects[p].size());
  int worst = 0, steepest = 0;
  for (std::size_t b = 0; b < baked.rects[p].size(); ++b) {
    const bake::TexelRect &own = baked.rects[p][b], &lent = baked.rects.back()[b];
    for (const double u : {0.0, 1.0})
      for (const double v : {0.0, 1.0}) worst = std::max(worst, std::abs(green(own, u, v) - green(lent, u, v)));
    steepest = std::max(steepest, std::abs(green(own, 0, 1) - green(own, 1, 0)));
  }
  CHECK(worst <= 2);
  CHECK(steepest > 10);  // taken crosswise it would be seen
}

TEST_CASE("frames are lit at their mirrors as just before them", "[bake]") {
  const LitRoom l = lit(GENERATE("*222", "*333", "*22222"));
  std::size_t asked = 0, off = 0;
  for (std::size_t p = 0; p < l.interior.parts.size(); ++p) {
    const place::PlacedMesh& part = l.interior.parts[p];
    if (part.kind != place::PartKind::frame) continue;
    const room::Wall& wall = l.interior.polygon.walls[static_cast<std::size_t>(part.wall)];
    for (std::size_t t = 0; t < part.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        // An edge on the mirror, asked in its middle: its ends lie in the frame's own corners.
        const auto on_mirror = [&](std::size_t c) {
          return std::fabs(geometry::value_at(wall.line, part.floor[part.triangles[t][c % 3]])) < 1e-9;
        };
        if (!on_mirror(k + 1) || !on_mirror(k + 2)) continue;
        std::array<double, 3> at{0.5, 0.5, 0.5}, before{0.499, 0.499, 0.499};
        at[k] = 0, before[k] = 0.002;
        const double there = light::irradiance(l.lighting, surface::shading_point(l.interior, part, l.lighting.normals[p], t, at)).g;
        const double near = light::irradiance(l.lighting, surface::shading_point(l.interior, part, l.lighting.normals[p], t, before)).g;
        ++asked;
        off += std::fabs(there - near) > 0.05 * std::max(there, near);
      }
  }
  CHECK(asked > 10);
  CHECK(off <= asked / 20);  // borders of shadows
}
