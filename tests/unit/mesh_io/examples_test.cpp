#include <catch2/catch.hpp>
#include <filesystem>

#include "compiler/mesh/analyse.h"
#include "compiler/mesh/decimate.h"
#include "compiler/mesh_io/load.h"

using namespace orbc;
using namespace orbc::mesh;
using namespace orbc::mesh_io;

namespace {

const std::string kSource = ORBC_SOURCE_DIR;

}  // namespace

TEST_CASE("the meshes of the examples are sound, small and as large as their page says", "[mesh_io]") {
  const auto sound = [](const std::string& name, std::size_t least, std::size_t most) {
    INFO(name);
    const auto path = kSource + "/examples/meshes/" + name;
    const auto loaded = load_mesh(path);
    if (!loaded) FAIL(to_text(loaded.error()));
    CHECK(loaded->warnings.empty());
    const auto found = analyse(loaded->mesh);
    CHECK(to_text(report_warnings(found, name)) == "");
    CHECK(found.closed);
    CHECK(found.lowest.z > -1e-6);
    CHECK(loaded->mesh.triangles.size() >= least);
    CHECK(loaded->mesh.triangles.size() <= most);
    CHECK(std::filesystem::file_size(path) < 1'500'000);
    return loaded->mesh;
  };
  const auto statue = sound("statue.ply", 25'990, 26'000);
  sound("statue_small.ply", 4'990, 5'000);
  sound("dragon.ply", 27'990, 28'000);
  const auto loaded = load_mesh(kSource + "/examples/meshes/vase.glb");
  REQUIRE(loaded);
  CHECK(loaded->warnings.empty());
  CHECK(loaded->mesh.triangles.size() == 16'064);
  CHECK(to_text(report_warnings(analyse(loaded->mesh), "vase")) == "");
  CHECK(loaded->mesh.uv.size() == loaded->mesh.positions.size());
  REQUIRE(loaded->mesh.textures.size() == 1);
  CHECK(loaded->mesh.textures[0].width == 1024);
  const auto coarse = decimate(statue, {.triangles = 3000});
  CHECK(analyse(coarse.mesh).closed);
  CHECK(coarse.error < 0.02);
}

TEST_CASE("the knot has the number of triangles of the paper's speed scene", "[mesh_io]") {
  const auto loaded = load_mesh(kSource + "/examples/meshes/knot.ply");
  REQUIRE(loaded);
  CHECK(loaded->mesh.triangles.size() == 26'022);
  const auto found = analyse(loaded->mesh);
  CHECK(to_text(report_warnings(found, "knot")) == "");
  CHECK(found.euler == 0);
}

TEST_CASE("the small test meshes are what their names say", "[mesh_io]") {
  const auto code = [](const std::string& name) {
    const auto loaded = load_mesh(kSource + "/tests/meshes/" + name);
    return loaded ? std::string("fine") : loaded.error().front().code;
  };
  for (const auto* name : {"tetra.obj", "tetra.off", "ascii.ply", "little.ply", "big.ply", "binary.stl", "text.stl", "tetra.glb",
                           "tetra.gltf", "inside_out.obj", "open.off"})
    CHECK(code(name) == "fine");
  CHECK(code("broken_truncated.ply") == "mesh.truncated");
  CHECK(code("broken_four_billion.ply") == "mesh.too-big");
  CHECK(code("broken_index.obj") == "mesh.bad-index");
  CHECK(code("broken_nan.off") == "mesh.not-finite");
  CHECK(code("broken_count.stl") == "mesh.truncated");
  CHECK(code("broken_traversal.gltf") == "mesh.bad-reference");
  CHECK(code("broken_chunk.glb") == "mesh.truncated");
  CHECK(analyse(load_mesh(kSource + "/tests/meshes/inside_out.obj")->mesh).inside_out);
  CHECK(analyse(load_mesh(kSource + "/tests/meshes/open.off")->mesh).open_edges == 4);
}
