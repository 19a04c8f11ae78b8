#include <catch2/catch.hpp>
#include <cmath>

#include "compiler/bake/baked_light.h"
#include "compiler/geometry/point.h"
#include "compiler/image/srgb.h"
#include "compiler/lod/build.h"
#include "compiler/mesh_io/load.h"
#include "compiler/notation/parse.h"
#include "compiler/place/furnish.h"
#include "compiler/room/realise.h"
#include "compiler/scene/defaults.h"
#include "compiler/surface/tangent_frame.h"

using namespace orbc;

TEST_CASE("light that surfaces pass on is on a box's coarsest level what it is on the box, up to the edges", "[lod]") {
  const char* notation = GENERATE("*222", "*2222", "*22222");
  scene::Scene scene = scene::default_scene(notation::parse(notation).value());
  scene.objects.resize(1);
  scene.objects[0].shape = scene::BoxSpec{{0.16, 0.16, 0.34}};
  scene.objects[0].place.floor = scene::AtPolar{0.2, Angle::from_degrees(150)};
  scene::Lamp lamp;
  lamp.kind = scene::LampKind::disk;
  lamp.place.floor = scene::AtPolar{0.05, Angle::from_degrees(30)};
  lamp.place.z = 0.95 * scene.room.height;
  lamp.power = 3;
  scene.lamps = {lamp};
  const place::Interior room =
      place::furnish(scene, room::realise(scene.orbifold, scene.room.shape).value(), mesh_io::assets_from_files()).value().interior;
  const geometry::Space space = room.polygon.space;
  light::LightOptions lit;
  lit.indirect_bounces = 8, lit.bounces = 2;
  const light::LightingContext lighting = light::prepare_light(scene, room, lit).value();

  place::Interior both = room;
  const lod::InteriorWithLods lods = lod::build_lods(room, serial_executor());
  for (const std::vector<std::uint32_t>& chain : lods.part_of_level)
    if (chain.size() > 1) both.parts.push_back(lods.interior.parts[chain.back()]);
  REQUIRE(both.parts.size() == room.parts.size() + 1);
  const place::PlacedMesh& coarse = both.parts.back();
  const bake::DiffuseBake baked = bake::bake_diffuse(both, lighting, bake::BakeOptions{}, serial_executor()).value();
  const bake::BakedLight known(room, baked);
  // Its light is that of the box: fewer points of it are asked than it has vertices.
  const bake::DiffuseBake alone = bake::bake_diffuse(room, lighting, bake::BakeOptions{}, serial_executor()).value();
  CHECK(baked.counts.lit_points < alone.counts.lit_points + coarse.floor.size());

  const surface::PartNormals normals = surface::part_normals(both, coarse);
  int compared = 0, off = 0;
  for (std::size_t b = 0; b < baked.patches.back().size(); ++b) {
    const bake::TexelPatch& patch = baked.patches.back()[b];
    const bake::TexelRect& rect = baked.rects.back()[b];
    for (const double u : {0.01, 0.3, 0.7, 0.99})
      for (const double v : {0.01, 0.3, 0.7, 0.99}) {
        if (patch.second < 0 && u + v > 1) continue;
        const bake::BarycentricPoint in = bake::barycentric_point(patch, u, v);
        const surface::ShadingPoint at = surface::shading_point(both, coarse, normals, in.triangle, in.b);
        if (at.at.z < 0.01) continue;
        // What the box itself shows there, seen from just before it.
        const surface::TangentFrame frame = surface::tangent_frame(space, at.at.floor);
        const geometry::Vector3 out = surface::to_local(space, frame, at.geometric_normal);
        const geometry::Position before = surface::exponential(space, at.at, frame, 0.02 * out);
        const surface::TangentFrame there = surface::tangent_frame(space, before.floor);
        const trace::Ray ray = trace::ray_from(space, before, surface::to_ambient(there, -1.0 * out));
        const trace::Hit hit = trace::closest_triangle(lighting.scene, ray, 0.05);
        if (hit.kind != trace::HitKind::triangle) continue;
        const trace::SurfacePoint seen = trace::surface_at(lighting.scene, ray, hit);
        const auto shown = known.at(seen, hit);
        if (!shown || trace::inner(space, light::shading_point(lighting, room, seen, hit).normal, at.normal) < 0.7) continue;
        const auto x = static_cast<int>(std::lround(u * (rect.width - 1))), y = static_cast<int>(std::lround(v * (rect.height - 1)));
        const double texel = baked.atlas.image.rgba[4 * static_cast<std::size_t>((rect.y + y) * baked.atlas.image.width + rect.x + x) + 1];
        ++compared;
        off += std::fabs(texel - 255 * image::encode_srgb(shown->g)) > 15;
      }
  }
  INFO(off << " of " << compared << " are off");
  CHECK(compared > 150);
  CHECK(off == 0);
}
