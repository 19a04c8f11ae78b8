#include "compiler/native_lights/split.h"

#include <catch2/catch.hpp>

#include "compiler/native_lights/normals.h"

using namespace orbc;
using native_lights::Shading;

namespace {

/// A matte, an emissive and a mixed object, of one triangle or two.
place::Interior three_objects() {
  place::Interior room;
  room.styles.resize(2);
  room.styles[0].material.kind = scene::MaterialKind::glossy;
  room.styles[1].material.kind = scene::MaterialKind::emissive;
  room.styles[1].material.emission = 2;
  for (const std::vector<std::uint16_t>& styles : {std::vector<std::uint16_t>{0}, {1}, {0, 1}}) {
    place::PlacedMesh part;
    part.floor.resize(3);
    part.z = {0, 1, 2};
    part.triangles.resize(styles.size(), mesh::Triangle{0, 1, 2});
    part.style = styles;
    room.parts.push_back(part);
  }
  return room;
}

}  // namespace

TEST_CASE("the unlit copy is matte but for emissive surfaces, which have parts of their own and the exposure", "[native_lights]") {
  scene::Scene scene;
  scene.lamps.resize(1);
  scene.exposure = 0.5;
  const native_lights::UnlitCopy copy = native_lights::unlit_copy(scene, three_objects());
  CHECK(copy.scene.lamps.empty());
  CHECK(copy.scene.exposure == 1);
  CHECK(copy.interior.styles[0].material.kind == scene::MaterialKind::matte);
  CHECK(copy.interior.styles[1].material.emission == 1);
  REQUIRE(copy.interior.parts.size() == 4);
  const Shading expected[] = {Shading::lit, Shading::emissive, Shading::lit, Shading::emissive};
  for (std::size_t p = 0; p < 4; ++p) {
    CHECK(copy.interior.parts[p].triangles.size() == 1);
    CHECK(native_lights::shading_of(copy.interior, copy.interior.parts[p]) == expected[p]);
  }
}

TEST_CASE("impostors are drawn like bodies of lamps: nothing lights them and they cast no shadow", "[native_lights]") {
  const place::Interior room = three_objects();
  place::PlacedMesh panel = room.parts[0];
  panel.style = {2};
  CHECK(native_lights::shading_of(room, panel) == Shading::lamp_body);
}

TEST_CASE("only lit scenes that ask for it have native lights", "[native_lights]") {
  scene::Scene scene;
  scene.bake.lights = scene::LightMode::native;
  CHECK_FALSE(native_lights::uses_native_lights(scene));
  scene.lamps.resize(1);
  CHECK(native_lights::uses_native_lights(scene));
  scene.bake.lights = scene::LightMode::baked;
  CHECK_FALSE(native_lights::uses_native_lights(scene));
}

TEST_CASE("vertices are repeated where faces meet at an edge", "[native_lights]") {
  bend::BentCover cover;  // two triangles at a right angle
  cover.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  cover.uv.resize(4);
  cover.indices = {0, 1, 2, 1, 0, 3};
  cover.copies = {{0, 4, 0, 6}};
  const native_lights::CoverWithNormals made = native_lights::with_normals(cover, serial_executor());
  CHECK(made.cover.positions.size() == 6);
  REQUIRE(made.normals.size() == 6);
  CHECK(made.cover.copies[0].vertex_count == 6);
  for (std::size_t i = 0; i < 3; ++i) CHECK(made.normals[made.cover.indices[i]][2] == Approx(1));
  for (std::size_t i = 3; i < 6; ++i) CHECK(made.normals[made.cover.indices[i]][1] == Approx(1));
}
