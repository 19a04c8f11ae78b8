#include "compiler/bake/diffuse.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "compiler/image/image.h"
#include "compiler/image/srgb.h"
#include "compiler/mesh_io/load.h"
#include "tests/support/lit_room.h"

using namespace orbc;
using test::light_room;
using test::lit_scene;
using test::LitRoom;

TEST_CASE("patterns need a bake even without lamps, plain colours need none", "[bake]") {
  scene::Scene scene = scene::default_scene(notation::parse("*222").value());
  const room::Room room = room::realise(scene.orbifold, scene.room.shape).value();
  CHECK_FALSE(bake::needs_bake(scene, place::furnish(scene, room, mesh_io::assets_from_files()).value().interior));
  scene.room.floor.material.pattern = scene::Pattern::marble;
  CHECK(bake::needs_bake(scene, place::furnish(scene, room, mesh_io::assets_from_files()).value().interior));
}

TEST_CASE("the bake holds the light of every point, and the same bytes for any executor", "[bake]") {
  scene::Scene scene = lit_scene("*22222", scene::LampKind::sphere, true);
  scene.objects.resize(1);
  scene.objects[0].shape = scene::SphereSpec{0.1};
  scene.objects[0].place.floor = scene::AtPolar{0.25, Angle::from_degrees(200)};
  scene.ambient = {0.2, 0.2, 0.2};
  const LitRoom l = light_room(scene, 1);
  bake::BakeOptions options;
  options.min_density = 12, options.max_density = 48;
  const bake::DiffuseBake baked = bake::bake_diffuse(l.interior, l.lighting, options, serial_executor()).value();
  const Executor backwards = [](std::size_t count, const std::function<void(std::size_t)>& task) {
    for (std::size_t i = count; i-- > 0;) task(i);
  };
  CHECK(bake::bake_diffuse(l.interior, l.lighting, options, backwards)->atlas.image.rgba == baked.atlas.image.rgba);
  CHECK(baked.atlas.image16.rgb.empty());
  options.with_image16 = true;
  const bake::Atlas deep = bake::bake_diffuse(l.interior, l.lighting, options, serial_executor())->atlas;
  REQUIRE(deep.image.rgba == baked.atlas.image.rgba);
  REQUIRE(deep.image16.rgb.size() == deep.image.rgba.size() / 4 * 3);
  std::size_t finer = 0;
  double apart = 0;  // in steps of 8 bits: both are the same light, rounded
  for (std::size_t i = 0; i < deep.image16.rgb.size(); ++i) {
    apart = std::max(apart, std::fabs(deep.image16.rgb[i] / 257.0 - deep.image.rgba[i / 3 * 4 + i % 3]));
    finer += deep.image16.rgb[i] % 257 != 0;
  }
  CHECK(apart <= 0.502);
  CHECK(finer > deep.image16.rgb.size() / 2);
  int far_off = 0, asked = 0;
  const image::Image& image = baked.atlas.image;
  for (std::size_t p = 0; p < l.interior.parts.size(); ++p) {
    const place::PlacedMesh& part = l.interior.parts[p];
    REQUIRE(baked.atlas.room.parts[p].triangles.size() == part.triangles.size());
    for (std::size_t t = 0; t < part.triangles.size(); t += 7) {
      const std::array<double, 3> b{0.3, 0.5, 0.2};
      const scene::Color e = light::irradiance(l.lighting, surface::shading_point(l.interior, part, l.lighting.normals[p], t, b));
      const place::SurfaceStyle& look = l.interior.styles[part.style[t]];
      const double expected = 255 * image::encode_srgb(light::outgoing_radiance(l.lighting, look.material, look.color, e).g);
      double u = 0, v = 0;
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t id = baked.atlas.room.parts[p].triangles[t][k];
        u += b[k] * baked.atlas.uv[p][id][0], v += b[k] * baked.atlas.uv[p][id][1];
      }
      const double x = u * image.width - 0.5, y = v * image.height - 0.5;
      const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
      double linear = 0;
      for (int k = 0; k < 4; ++k) {
        const int xi = std::min(x0 + k % 2, image.width - 1), yi = std::min(y0 + k / 2, image.height - 1);
        const double w = (k % 2 ? x - x0 : 1 - x + x0) * (k / 2 ? y - y0 : 1 - y + y0);
        linear += w * image::decode_srgb(image.rgba[4 * (static_cast<std::size_t>(yi) * image.width + xi) + 1] / 255.0);
      }
      ++asked;
      far_off += std::fabs(255 * image::encode_srgb(linear) - expected) > 4;
    }
  }
  CHECK(far_off <= asked / 50);  // shadow borders
}

TEST_CASE("no lookup of baked light leaves its patch: the nearest texel, or the four that POV-Ray, Cycles and WebGL blend", "[bake]") {
  // They blend linear light or codes, wrap or clamp: all the same as long as the four are the patch's own.
  scene::Scene scene = lit_scene("*2222", scene::LampKind::sphere, true);
  scene.objects.resize(1);
  scene.objects[0].shape = scene::SphereSpec{0.1};
  const LitRoom l = light_room(scene, 0);
  bake::BakeOptions options;
  options.min_density = 6, options.max_density = 24;
  const bake::DiffuseBake baked = bake::bake_diffuse(l.interior, l.lighting, options, serial_executor()).value();
  const image::Image& image = baked.atlas.image;
  for (std::size_t p = 0; p < l.interior.parts.size(); ++p) {
    std::vector<const bake::TexelRect*> rect(l.interior.parts[p].triangles.size(), nullptr);
    for (std::size_t i = 0; i < baked.patches[p].size(); ++i) {
      rect[baked.patches[p][i].first] = &baked.rects[p][i];
      if (baked.patches[p][i].second >= 0) rect[static_cast<std::size_t>(baked.patches[p][i].second)] = &baked.rects[p][i];
    }
    for (std::size_t t = 0; t < rect.size(); ++t)
      for (const std::array<double, 3>& b : {std::array{1.0, 0.0, 0.0},
                                             {0.0, 1.0, 0.0},
                                             {0.0, 0.0, 1.0},
                                             {0.5, 0.5, 0.0},
                                             {0.0, 0.5, 0.5},
                                             {0.5, 0.0, 0.5},
                                             {0.3, 0.3, 0.4}}) {
        double at[2] = {0, 0};
        for (std::size_t k = 0; k < 3; ++k)
          for (std::size_t c = 0; c < 2; ++c)
            at[c] += b[k] * static_cast<double>(baked.atlas.uv[p][baked.atlas.room.parts[p].triangles[t][k]][c]);
        const double x = at[0] * image.width - 0.5, y = at[1] * image.height - 0.5;
        constexpr double kNothing = 2e-3;  // of a texel: what single precision leaves
        REQUIRE(x > rect[t]->x - kNothing);
        REQUIRE(y > rect[t]->y - kNothing);
        REQUIRE(x < rect[t]->x + rect[t]->width - 1 + kNothing);
        REQUIRE(y < rect[t]->y + rect[t]->height - 1 + kNothing);
      }
  }
}
