#include "compiler/bake/atlas.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "compiler/image/image.h"
#include "compiler/image/srgb.h"
#include "compiler/mesh_io/load.h"
#include "compiler/notation/parse.h"
#include "compiler/place/furnish.h"
#include "compiler/room/realise.h"
#include "compiler/scene/defaults.h"

using namespace orbc;
using bake::Atlas;
using bake::make_atlas;

namespace {

using Texel = std::array<int, 4>;

Texel texel(const image::Image& image, int x, int y) {
  Texel t;
  for (int c = 0; c < 4; ++c) t[c] = image.rgba[4 * (static_cast<std::size_t>(y) * image.width + x) + c];
  return t;
}

Texel nearest(const image::Image& image, double u, double v) {
  return texel(image, std::clamp(static_cast<int>(std::floor(u * image.width)), 0, image.width - 1),
               std::clamp(static_cast<int>(std::floor(v * image.height)), 0, image.height - 1));
}

// The four texels that bilinear lookup blends, wrapped at the borders.
std::array<Texel, 4> blended(const image::Image& image, double u, double v) {
  const auto wrap = [](int i, int n) { return ((i % n) + n) % n; };
  const int x = static_cast<int>(std::floor(u * image.width - 0.5)), y = static_cast<int>(std::floor(v * image.height - 0.5));
  std::array<Texel, 4> all;
  for (int i = 0; i < 4; ++i) all[i] = texel(image, wrap(x + i % 2, image.width), wrap(y + i / 2, image.height));
  return all;
}

int encoded(double linear) { return static_cast<int>(std::lround(255 * image::encode_srgb(linear))); }

image::Image noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  image::Image image{width, height, {}};
  for (int i = 0; i < width * height * 4; ++i) image.rgba.push_back(i % 4 == 3 ? 255 : static_cast<std::uint8_t>(random() & 255));
  return image;
}

place::Interior furnished(scene::Scene scene) {
  scene.allow_non_orbifold = true;
  return place::furnish(scene, room::realise(scene.orbifold, scene.room.shape).value(), mesh_io::assets_from_files()).value().interior;
}

// One triangle of texture 0 over the whole picture.
place::Interior textured(place::PartKind kind, const image::Image& image, const scene::Color& tint) {
  place::Interior room;
  room.textures = {image};
  room.styles.push_back({tint, 0, {}});
  place::PlacedMesh part;
  part.kind = kind;
  part.floor = {{1, 0, 0}, {1, 1, 0}, {1, 0, 1}, {1, 1, 1}};
  part.z = {0, 0, 0, 0};
  part.uv = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  part.triangles = {{0, 1, 2}, {2, 1, 3}};
  part.style = {0, 0};
  room.parts = {part};
  return room;
}

}  // namespace

TEST_CASE("every triangle of a plain room reads its own colour, however a renderer looks it up", "[bake]") {
  scene::Scene scene = scene::default_scene(notation::parse("*22222").value());
  scene::Object ball;
  ball.shape = scene::SphereSpec{0.1};
  ball.material.emplace().color = {0.9, 0.1, 0.02};
  ball.material->pattern = scene::Pattern::checker;
  ball.material->cell = 0.05;
  scene.objects = {ball};
  const place::Interior room = furnished(scene);
  const Atlas atlas = make_atlas(room).value();
  REQUIRE(atlas.room.parts.size() == room.parts.size());
  for (std::size_t p = 0; p < room.parts.size(); ++p) {
    const place::PlacedMesh &before = room.parts[p], &after = atlas.room.parts[p];
    REQUIRE(after.triangles.size() == before.triangles.size());
    REQUIRE(atlas.uv[p].size() == after.floor.size());
    for (std::size_t t = 0; t < before.triangles.size(); ++t) {
      const scene::Color& color = room.styles[before.style[t]].color;
      const Texel wanted{encoded(color.r), encoded(color.g), encoded(color.b), 255};
      for (int i = 0; i < 3; ++i) {
        const std::uint32_t a = before.triangles[t][i], b = after.triangles[t][i];
        REQUIRE((before.floor[a].x == after.floor[b].x && before.floor[a].y == after.floor[b].y && before.z[a] == after.z[b]));
        const auto& uv = atlas.uv[p][b];
        REQUIRE(nearest(atlas.image, uv[0], uv[1]) == wanted);
        for (const Texel& one : blended(atlas.image, uv[0], uv[1])) REQUIRE(one == wanted);
        // Even half a texel off, as through mipmaps or half-float uv.
        for (const Texel& one : blended(atlas.image, uv[0] + 1.0 / atlas.image.width, uv[1] - 1.0 / atlas.image.height))
          REQUIRE(one == wanted);
      }
    }
  }
  CHECK(atlas.image.width * atlas.image.height <= 1024);
}

TEST_CASE("equal colours share a block, and vertices are doubled only between colours", "[bake]") {
  const place::Interior room = furnished(scene::default_scene(notation::parse("*2222").value()));
  const Atlas atlas = make_atlas(room).value();
  std::size_t ceiling = 1;
  CHECK(atlas.room.parts[ceiling].floor.size() == room.parts[ceiling].floor.size());
  CHECK(atlas.room.parts[0].floor.size() > room.parts[0].floor.size());
  CHECK(atlas.room.parts[0].floor.size() <= 2 * room.parts[0].floor.size());
  place::Interior same = room;
  for (place::SurfaceStyle& look : same.styles) look.color = {0.5, 0.5, 0.5};
  const Atlas one = make_atlas(same).value();
  CHECK(one.image.width == 16);
  CHECK(one.image.height == 4);
  CHECK(one.room.parts[0].floor.size() == room.parts[0].floor.size());
}

TEST_CASE("a picture is copied texel by texel; texel centres keep their place", "[bake]") {
  const image::Image image = noise(37, 21, 4);
  for (const auto kind : {place::PartKind::object, place::PartKind::floor}) {
    const Atlas atlas = make_atlas(textured(kind, image, {1, 1, 1})).value();
    const auto& uv = atlas.uv[0];
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const double s = (x + 0.5) / image.width, t = (y + 0.5) / image.height;
        const double u = (1 - s) * uv[0][0] + s * uv[1][0], v = (1 - t) * uv[0][1] + t * uv[2][1];
        REQUIRE(nearest(atlas.image, u, v) == texel(image, x, y));
      }
    // At the picture's border bilinear lookup sees the border again, or the other side of a tile.
    const double u = uv[0][0], v = uv[0][1] + 0.75 / atlas.image.height;
    const auto four = blended(atlas.image, u, v);
    CHECK(four[1] == texel(image, 0, 0));
    CHECK(four[0] == texel(image, kind == place::PartKind::object ? 0 : image.width - 1, 0));
  }
}

TEST_CASE("a tint multiplies a picture in linear light", "[bake]") {
  const image::Image image = noise(8, 8, 5);
  const Atlas atlas = make_atlas(textured(place::PartKind::object, image, {0.5, 1, 0})).value();
  const auto& uv = atlas.uv[0][0];
  const Texel got = nearest(atlas.image, uv[0] + 0.5 / atlas.image.width, uv[1] + 0.5 / atlas.image.height), own = texel(image, 0, 0);
  CHECK(got[0] == encoded(0.5 * image::decode_srgb(own[0] / 255.0)));
  CHECK(got[1] == own[1]);
  CHECK(got[2] == 0);
}

TEST_CASE("pictures that fit nowhere are refused", "[bake]") {
  bake::AtlasOptions options;
  options.max_side = 32;
  CHECK(make_atlas(textured(place::PartKind::object, noise(24, 24, 1), {1, 1, 1}), options).has_value());
  const auto refused = make_atlas(textured(place::PartKind::object, noise(25, 25, 1), {1, 1, 1}), options);
  REQUIRE(!refused);
  CHECK(refused.error()[0].code == "light.atlas-too-large");
  CHECK(refused.error()[0].hint.find("25×25") != std::string::npos);
}

TEST_CASE("many pictures are packed without overlap, the same way each time", "[bake]") {
  place::Interior room = textured(place::PartKind::object, noise(30, 10, 0), {1, 1, 1});
  for (unsigned i = 1; i < 40; ++i) {
    room.textures.push_back(noise(5 + static_cast<int>(i * 7 % 50), 3 + static_cast<int>(i * 11 % 40), i));
    room.styles.push_back({{1, 1, 1}, static_cast<int>(i), {}});
    room.styles.push_back({{0.01 * i, 0.2, 0.3}, -1, {}});
    place::PlacedMesh part = room.parts[0];
    part.style = {static_cast<std::uint16_t>(2 * i - 1), static_cast<std::uint16_t>(2 * i)};
    room.parts.push_back(part);
  }
  const Atlas atlas = make_atlas(room).value(), again = make_atlas(room).value();
  CHECK(atlas.image.rgba == again.image.rgba);
  CHECK(atlas.uv == again.uv);
  for (unsigned i = 1; i < 40; ++i) {
    // The first triangle has the picture: its corners' texels are there.
    const auto& uv = atlas.uv[i];
    const auto& t = atlas.room.parts[i].triangles[0];
    const image::Image& image = room.textures[i];
    const double dx = 0.5 / atlas.image.width, dy = 0.5 / atlas.image.height;
    CHECK(nearest(atlas.image, uv[t[0]][0] + dx, uv[t[0]][1] + dy) == texel(image, 0, 0));
    CHECK(nearest(atlas.image, uv[t[1]][0] - dx, uv[t[1]][1] + dy) == texel(image, image.width - 1, 0));
    CHECK(nearest(atlas.image, uv[t[2]][0] + dx, uv[t[2]][1] - dy) == texel(image, 0, image.height - 1));
  }
}

TEST_CASE("sixteen bits hold colours and tinted pictures more finely than eight", "[bake]") {
  place::Interior room = textured(place::PartKind::object, noise(16, 16, 7), {0.61, 0.37, 0.083});
  for (int i = 0; i < 64; ++i) {
    room.styles.push_back({{0.0002 * i * i, 0.01 + 0.003 * i, 0.9 / (i + 1)}, -1, {}});
    place::PlacedMesh part = room.parts[0];
    part.style = {static_cast<std::uint16_t>(i + 1), static_cast<std::uint16_t>(i + 1)};
    room.parts.push_back(part);
  }
  bake::AtlasOptions options;
  CHECK(make_atlas(room, options).value().image16.rgb.empty());
  options.with_image16 = true;
  const Atlas atlas = make_atlas(room, options).value();
  REQUIRE(atlas.image16.rgb.size() == atlas.image.rgba.size() / 4 * 3);
  double worst_8 = 0, worst_16 = 0;
  const auto judge = [&](double u, double v, const scene::Color& wanted) {
    const std::size_t at = static_cast<std::size_t>(v * atlas.image.height) * static_cast<std::size_t>(atlas.image.width) +
                           static_cast<std::size_t>(u * atlas.image.width);
    const double own[] = {wanted.r, wanted.g, wanted.b};
    for (std::size_t c = 0; c < 3; ++c) {
      worst_8 = std::max(worst_8, std::fabs(image::decode_srgb(atlas.image.rgba[4 * at + c] / 255.0) - own[c]));
      worst_16 = std::max(worst_16, std::fabs(image::decode_srgb(atlas.image16.rgb[3 * at + c] / 65535.0) - own[c]));
    }
  };
  for (std::size_t p = 1; p < room.parts.size(); ++p) judge(atlas.uv[p][0][0], atlas.uv[p][0][1], room.styles[p].color);
  const auto& uv = atlas.uv[0];
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const Texel own = texel(room.textures[0], x, y);
      const double s = (x + 0.5) / 16, t = (y + 0.5) / 16;
      judge((1 - s) * uv[0][0] + s * uv[1][0], (1 - t) * uv[0][1] + t * uv[2][1],
            room.styles[0].color *
                scene::Color{image::decode_srgb(own[0] / 255.0), image::decode_srgb(own[1] / 255.0), image::decode_srgb(own[2] / 255.0)});
    }
  CHECK(worst_8 > 1e-3);
  CHECK(worst_16 < 2e-5);  // half a step of 1/65535, at most 2.3 of them in linear light
}

TEST_CASE("holes of a picture are transparent in the atlas, and only there is anything so", "[bake]") {
  image::Image image = noise(20, 12, 3);
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = static_cast<std::uint8_t>(i * 37 % 256);
  place::Interior room = textured(place::PartKind::object, image, {1, 1, 1});
  for (const double cutoff : {-1.0, 0.25, 0.5}) {
    room.styles[0].alpha_cutoff = cutoff;
    const Atlas atlas = make_atlas(room).value();
    const auto& uv = atlas.uv[0];
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const double s = (x + 0.5) / image.width, t = (y + 0.5) / image.height;
        const Texel got = nearest(atlas.image, (1 - s) * uv[0][0] + s * uv[1][0], (1 - t) * uv[0][1] + t * uv[2][1]),
                    own = texel(image, x, y);
        REQUIRE(got[3] == (own[3] < cutoff * 255 ? 0 : 255));
        REQUIRE(got[0] == own[0]);
      }
  }
}
