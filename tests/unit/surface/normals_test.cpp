#include "compiler/surface/normals.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "compiler/mesh_io/load.h"
#include "compiler/notation/parse.h"
#include "compiler/place/furnish.h"
#include "compiler/room/realise.h"
#include "compiler/scene/defaults.h"

using namespace orbc;

TEST_CASE("the normals of a ball are those of the sphere, those of a box are its faces'", "[surface]") {
  scene::Scene scene = scene::default_scene(notation::parse("*22222").value());
  scene.objects.resize(2);
  scene.objects[0].shape = scene::SphereSpec{0.1};
  scene.objects[1].shape = scene::BoxSpec{};
  scene.objects[1].place.floor = scene::AtPolar{0.3, Angle::from_degrees(120)};
  const place::Interior room =
      place::furnish(scene, room::realise(scene.orbifold, scene.room.shape).value(), mesh_io::assets_from_files()).value().interior;
  const std::size_t count = room.parts.size();
  const place::PlacedMesh &ball = room.parts[count - 2], &box = room.parts[count - 1];
  const surface::PartNormals round = surface::part_normals(room, ball), flat = surface::part_normals(room, box);
  CHECK(round.vertices.size() == ball.floor.size());
  for (const surface::ShadingVertex& v : round.vertices) {
    const double z = (ball.z[v.vertex] - 0.1) / 0.1;
    CHECK(v.normal.z == Approx(z).margin(0.05));
  }
  for (const surface::ShadingVertex& v : flat.vertices) CHECK(std::min(std::fabs(std::fabs(v.normal.z) - 1), std::fabs(v.normal.z)) < 1e-9);
}
