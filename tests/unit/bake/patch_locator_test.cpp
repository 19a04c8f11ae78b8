#include "compiler/bake/patch_locator.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "compiler/bake/diffuse.h"
#include "compiler/mesh_io/load.h"
#include "compiler/notation/parse.h"
#include "compiler/place/furnish.h"
#include "compiler/place/locate.h"
#include "compiler/room/realise.h"
#include "compiler/room/room.h"
#include "compiler/scene/defaults.h"

using namespace orbc;
using geometry::Position;

namespace {

/// A room whose walls are all plain, so that each has triangles.
struct Plain {
  scene::Scene scene;
  place::Interior room;
  std::vector<surface::PartNormals> normals;
  std::vector<std::vector<bake::TexelPatch>> patches;
};

Plain plain(const char* notation) {
  Plain p;
  p.scene = scene::default_scene(notation::parse(notation).value());
  for (scene::Wall& wall : p.scene.room.walls) wall.mirrors.clear();
  p.scene.lamps.clear(), p.scene.objects.clear();
  p.room =
      place::furnish(p.scene, room::realise(p.scene.orbifold, p.scene.room.shape).value(), mesh_io::assets_from_files()).value().interior;
  for (std::uint32_t i = 0; i < p.room.parts.size(); ++i) {
    p.normals.push_back(surface::part_normals(p.room, p.room.parts[i]));
    p.patches.push_back(bake::make_patches(p.room, i, p.normals.back()));
  }
  return p;
}

/// How far the place that the map found lies from a point: by the patch's own formula.
double missed(const Plain& p, const bake::PatchLocator& map, const Position& at, trace::HitKind target, int wall) {
  trace::SurfacePoint point;
  point.at = at;
  trace::Hit hit;
  hit.kind = target, hit.wall = wall;
  const bake::PatchUv found = map.find(point, hit);
  if (found.patch < 0) return 1e9;
  std::size_t i = static_cast<std::size_t>(found.patch), part = 0;
  while (i >= p.patches[part].size()) i -= p.patches[part++].size();
  const bake::BarycentricPoint in = bake::barycentric_point(p.patches[part][i], static_cast<double>(found.u), static_cast<double>(found.v));
  const Position there = surface::shading_point(p.room, p.room.parts[part], p.normals[part], in.triangle, in.b).at;
  return std::hypot(geometry::distance(p.room.polygon.space, there.floor, at.floor), there.z - at.z);
}

}  // namespace

TEST_CASE("where light ends on floor, ceiling or a wall is found on its triangle, also on half spheres and lunes", "[bake]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> is_linear(0, 1);
  for (const char* notation : {"*", "*22", "*33", "*77", "*222", "*235", "*333", "*2222", "*22222", "*237"}) {
    const Plain p = plain(notation);
    const bake::PatchLocator map(p.room, p.patches);
    const room::Room& room = p.room.polygon;
    double worst = 0;
    for (int i = 0; i < 3000; ++i) {
      const double turn = 2 * std::numbers::pi * is_linear(random), reach = place::distance_to_boundary(room, turn);
      // To the very rim, where w vanishes on half spheres and in the corners of lunes.
      const double r = i % 10 == 0 ? reach : reach * std::sqrt(is_linear(random));
      const geometry::Point at = geometry::point_along(room.space, {}, geometry::Tangent(0, std::cos(turn), std::sin(turn)), r);
      worst = std::max(worst, missed(p, map, {at, 0}, trace::HitKind::floor, -1));
      worst = std::max(worst, missed(p, map, {at, p.room.height}, trace::HitKind::ceiling, -1));
      const int w = static_cast<int>(is_linear(random) * static_cast<double>(room.walls.size()));
      const Position on_wall{room::point_on_wall(room, w, room.walls[static_cast<std::size_t>(w)].length * is_linear(random)),
                             p.room.height * is_linear(random)};
      worst = std::max(worst, missed(p, map, on_wall, trace::HitKind::wall, w));
    }
    INFO(notation);
    CHECK(worst < 1e-5);
  }
}

TEST_CASE("light passed on in half spheres and lunes is a number everywhere", "[bake]") {
  for (const char* notation : {"*", "*33"}) {
    scene::Scene scene = scene::default_scene(notation::parse(notation).value());
    scene::Lamp lamp;
    lamp.place.floor = scene::AtPolar{0.2, Angle::from_degrees(20)};
    lamp.place.z = 0.6;
    lamp.power = 10;
    scene.lamps = {lamp};
    scene.integrator = scene::Integrator::path;
    scene.bake.quality = scene::BakeQuality::draft;
    scene.bake.samples = 16;
    const place::Interior room =
        place::furnish(scene, room::realise(scene.orbifold, scene.room.shape).value(), mesh_io::assets_from_files()).value().interior;
    const light::LightingContext lighting = light::prepare_light(scene, room, bake::bake_light_options(scene)).value();
    const bake::DiffuseBake baked = bake::bake_diffuse(room, lighting, bake::bake_options(scene.bake), serial_executor()).value();
    // Black texels are what no numbers become.
    std::size_t black = 0;
    for (std::size_t part = 0; part < baked.rects.size(); ++part)
      for (const bake::TexelRect& rect : baked.rects[part])
        for (int y = rect.y; y < rect.y + rect.height; ++y)
          for (int x = rect.x; x < rect.x + rect.width; ++x) {
            const std::uint8_t* texel =
                baked.atlas.image.rgba.data() +
                4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(baked.atlas.image.width) + static_cast<std::size_t>(x));
            black += texel[0] == 0 && texel[1] == 0 && texel[2] == 0;
          }
    INFO(notation);
    CHECK(black == 0);
  }
}
