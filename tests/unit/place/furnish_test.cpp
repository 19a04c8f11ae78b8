#include "compiler/place/furnish.h"

#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>

#include "compiler/image/image.h"
#include "compiler/image_io/png.h"
#include "compiler/mesh_io/load.h"
#include "compiler/place/uv_repeats.h"
#include "rooms.h"

using namespace orbc;
using namespace orbc::place;
using namespace orbc::place::test;

namespace {

scene::Scene default_of(const std::string& notation) {
  notation::ParseOptions any;
  any.allow_non_orbifold = true;
  return scene::default_scene(notation::parse(notation, any).value());
}

Result<Furnished> furnished(const scene::Scene& scene) {
  return furnish(scene, room::realise(scene.orbifold, scene.room.shape, true).value(), mesh_io::assets_from_files());
}

// A folder with a picture and a mesh in it.
struct Folder {
  std::string path = ORBC_BINARY_DIR "/furnish_test";
  Folder() {
    std::filesystem::create_directories(path);
    image::Image image{8, 4, std::vector<std::uint8_t>(8 * 4 * 4, 200)};
    std::ofstream(path + "/tile.png", std::ios::binary) << image_io::encode_png(image);
    std::ofstream(path + "/tetra.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    std::ofstream(path + "/broken.obj") << "v 0 0 0\nf 1 2 3\n";
  }
};

scene::Object mesh_object(const std::string& file, double size) {
  scene::Object object;
  object.name = file;
  object.shape = scene::MeshFile{{file, {}}};
  object.size = size;
  return object;
}

}  // namespace

TEST_CASE("what is to be said of a mesh is said once, however often and however it is named", "[place]") {
  const Folder folder;
  std::ofstream(folder.path + "/inside-out.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
  scene::Scene scene = default_of("*2222");
  scene.folder = folder.path;
  const std::vector<std::string> ways = {"inside-out.obj", "./inside-out.obj", "inside-out.obj", "../furnish_test/inside-out.obj",
                                         folder.path + "/inside-out.obj"};
  for (const std::string& way : ways) {
    scene::Object object = mesh_object(way, 0.1);
    object.material.emplace().pattern = scene::Pattern::texture;
    object.material->texture.value = "tile.png";
    object.turn.radians = 0.1 * static_cast<double>(scene.objects.size());  // in one place, but not one in the other
    scene.objects.push_back(object);
  }
  const Furnished all = furnished(scene).value();
  CHECK(all.interior.parts.size() == 2 + ways.size());
  std::vector<std::string> codes;
  for (const Diagnostic& d : all.warnings) codes.push_back(d.code);
  CHECK(codes == std::vector<std::string>{"mesh.inside-out", "place.no-uv"});
}

TEST_CASE("frames that have no texture coordinates say so once, not wall by wall", "[place]") {
  const Folder folder;
  scene::Scene scene = default_of("*22222");
  scene.folder = folder.path;
  for (scene::Wall& wall : scene.room.walls) {
    scene::Frame& frame = wall.mirrors[0].frame.emplace();
    frame.material.pattern = scene::Pattern::texture;
    frame.material.texture.value = "tile.png";
  }
  const Furnished all = furnished(scene).value();
  REQUIRE(all.warnings.size() == 1);
  CHECK(all.warnings[0].code == "place.no-uv");
}

TEST_CASE("every default room is furnished: floor, ceiling, a full mirror on each wall", "[place]") {
  for (const std::string& notation : notations()) {
    CAPTURE(notation);
    const Furnished all = furnished(default_of(notation)).value();
    const std::size_t ends = notation == "**" ? 2 : notation == "*22∞" ? 1 : 0;
    CHECK(all.warnings.empty());
    REQUIRE(all.interior.parts.size() == 2 + ends);
    CHECK(all.interior.parts[0].name == "floor");
    CHECK(all.interior.parts[1].name == "ceiling");
    REQUIRE(all.interior.mirrors.size() == all.interior.polygon.walls.size() - ends);
    for (const PlacedMirror& m : all.interior.mirrors) {
      CHECK(m.span[1] == all.interior.polygon.walls[m.wall].length);
      CHECK(m.throughput == (scene::Color{0.9, 0.9, 0.9}));
    }
    for (const PlacedMesh& part : all.interior.parts) {
      CHECK(part.style.size() == part.triangles.size());
      for (const std::uint16_t look : part.style) CHECK(look < all.interior.styles.size());
    }
  }
}

TEST_CASE("floor and ceiling mirrors replace their panels", "[place]") {
  scene::Scene scene = default_of("*2222");
  scene.room.floor.mirror.emplace();
  scene.room.ceiling.mirror.emplace().reflectance = 0.5;
  const Furnished all = furnished(scene).value();
  CHECK(all.interior.parts.empty());
  REQUIRE(all.interior.mirrors.size() == 6);
  CHECK(all.interior.mirrors[4].wall == -1);
  CHECK(all.interior.mirrors[5].wall == -2);
  CHECK(all.interior.mirrors[5].throughput == (scene::Color{0.5, 0.5, 0.5}));
}

TEST_CASE("mirrors are clipped to their walls; one that misses its wall is left out with a warning", "[place]") {
  scene::Scene scene = default_of("*333");
  scene::Mirror low, gone;
  low.arc = {-1, 0.5};
  low.height = {0.5, 9};
  gone.arc = {90, 91};
  scene.room.walls[0].mirrors = {low, gone};
  const Furnished all = furnished(scene).value();
  REQUIRE(all.warnings.size() == 1);
  CHECK(all.warnings[0].code == "place.mirror-outside-wall");
  REQUIRE(all.interior.mirrors.size() == 3);
  CHECK(all.interior.mirrors[0].span[0] == 0);
  CHECK(all.interior.mirrors[0].span[1] == 0.5);
  CHECK(all.interior.mirrors[0].height[1] == 1);
}

TEST_CASE("frames, beams, primitives and mesh files become parts in the order of the scene", "[place]") {
  const Folder folder;
  scene::Scene scene = default_of("*22222");
  scene.folder = folder.path;
  scene.room.walls[2].mirrors[0].frame.emplace();
  scene::Object ball, beam;
  ball.name = "ball", ball.shape = scene::SphereSpec{0.1}, ball.material.emplace().color = {1, 0, 0};
  scene::BarSpec spec;
  spec.from.floor = scene::AtPolar{0.3, Angle::from_degrees(0)};
  spec.to.floor = scene::AtPolar{0.3, Angle::from_degrees(180)};
  spec.from.z = 0.8, spec.to.z = 0.9;
  beam.name = "beam", beam.shape = spec;
  scene.objects = {ball, beam, mesh_object("tetra.obj", 0.3)};
  const Furnished all = furnished(scene).value();
  REQUIRE(all.interior.parts.size() == 6);
  CHECK(all.interior.parts[2].kind == PartKind::frame);
  CHECK(all.interior.parts[2].wall == 2);
  CHECK(all.interior.parts[3].name == "ball");
  CHECK(all.interior.styles[all.interior.parts[3].style[0]].color.r == 1);
  CHECK(all.interior.parts[4].name == "beam");
  CHECK(all.interior.parts[5].name == "tetra.obj");
}

TEST_CASE("all that is wrong with the objects is told at once, and where", "[place]") {
  const Folder folder;
  scene::Scene scene = default_of("*22222");
  scene.folder = folder.path;
  scene.objects = {mesh_object("tetra.obj", 1.6), mesh_object("missing.obj", 0.1), mesh_object("broken.obj", 0.1)};
  scene.objects[0].size_span.line = 7;
  scene.objects[0].size_span.source = std::make_shared<SourceText>();
  const auto all = furnished(scene);
  REQUIRE(!all);
  REQUIRE(all.error().size() >= 3);
  CHECK(all.error()[0].code == "place.object-outside-room");
  CHECK(all.error()[0].span.line == 7);
  CHECK(all.error()[1].code == "mesh.missing-file");
  CHECK(all.error()[2].code.substr(0, 5) == "mesh.");
}

TEST_CASE("of things that coincide the first is shown, with a warning", "[place]") {
  scene::Scene scene = default_of("*2222");
  for (const char* name : {"a", "b"}) {
    scene::Object ball;
    ball.name = name;
    ball.shape = scene::SphereSpec{0.1};
    scene.objects.push_back(ball);
  }
  const Furnished all = furnished(scene).value();
  REQUIRE(all.warnings.size() == 1);
  CHECK(all.warnings[0].code == "place.coincident");
  CHECK(all.interior.parts.back().name == "a");
}

TEST_CASE("textures are loaded once and their uv lie in one repeat", "[place]") {
  const Folder folder;
  for (const char* notation : {"*", "*2222", "*22222"}) {
    CAPTURE(notation);
    scene::Scene scene = default_of(notation);
    scene.folder = folder.path;
    scene::Material tiles;
    tiles.pattern = scene::Pattern::texture;
    tiles.texture.value = "tile.png";
    tiles.cell = 0.3;
    scene.room.floor.material = scene.room.ceiling.material = scene.room.walls[0].material = tiles;
    scene.room.walls[0].mirrors.clear();
    const Furnished all = furnished(scene).value();
    REQUIRE(all.interior.textures.size() == 1);
    for (const PlacedMesh& part : all.interior.parts) {
      REQUIRE(part.uv.size() == part.floor.size());
      for (const auto& uv : part.uv) CHECK((uv[0] >= 0 && uv[0] <= 1 && uv[1] >= 0 && uv[1] <= 1));
    }
    // Doubling vertices opens no edge of the shell but those to the mirrors.
    for (const auto& [a, b] : open_edges(all.interior.parts)) {
      const geometry::Point middle =
          geometry::normalised_point(all.interior.polygon.space, geometry::Point{a[0], a[1], a[2]} + geometry::Point{b[0], b[1], b[2]});
      bool at_mirror = false;
      for (std::size_t i = 1; i < all.interior.polygon.walls.size(); ++i)
        at_mirror = at_mirror || std::fabs(geometry::value_at(all.interior.polygon.walls[i].line, middle)) < 1e-12;
      CHECK(at_mirror);
    }
  }
  scene::Scene scene = default_of("*2222");
  scene.room.floor.material.pattern = scene::Pattern::texture;
  scene.room.floor.material.texture.value = "nowhere.png";
  CHECK(furnished(scene).error()[0].code == "mesh.missing-file");
}

TEST_CASE("wrapping keeps every point's texel", "[place]") {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(0, 1);
  PlacedMesh mesh;
  mesh.floor = {{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}};
  mesh.z = {0, 0.5, 1, 0.5};
  mesh.uv = {{-0.5f, 0.25f}, {2.75f, 0.0f}, {3.0f, 4.0f}, {-1.25f, 3.5f}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.style = {0, 1};
  const PlacedMesh cut = cut_at_uv_repeats(geometry::Space::euclidean, mesh).value();
  CHECK(open_edges({cut}).size() > 4);
  for (const auto& [a, b] : open_edges({cut}))
    CHECK(((a[1] == b[1] && (a[1] == 0 || a[1] == 1)) || (a[2] == b[2] && (a[2] == 0 || a[2] == 1))));
  double total = 0;
  for (std::size_t i = 0; i < cut.triangles.size(); ++i) {
    const mesh::Triangle& t = cut.triangles[i];
    const double one = area(geometry::Space::euclidean, cut.floor[t[0]], cut.floor[t[1]], cut.floor[t[2]]);
    CHECK(one > 0);
    total += one;
    double x = 0, y = 0, u = 0, v = 0;
    for (int k = 0; k < 3; ++k) x += cut.floor[t[k]].x / 3, y += cut.floor[t[k]].y / 3, u += cut.uv[t[k]][0] / 3, v += cut.uv[t[k]][1] / 3;
    // The same point of the uncut triangle.
    CHECK(cut.style[i] == (y < x ? 0 : 1));
    const double b1 = y < x ? x - y : 0, b3 = y < x ? 0 : y - x, b2 = std::min(x, y), b0 = 1 - b1 - b2 - b3;
    const auto blend = [&](int k) { return b0 * mesh.uv[0][k] + b1 * mesh.uv[1][k] + b2 * mesh.uv[2][k] + b3 * mesh.uv[3][k]; };
    CHECK(blend(0) - std::floor(blend(0)) == Approx(u).margin(1e-5));
    CHECK(blend(1) - std::floor(blend(1)) == Approx(v).margin(1e-5));
  }
  CHECK(total == Approx(1));
  mesh.uv[2] = {1e6f, 0};
  CHECK(cut_at_uv_repeats(geometry::Space::euclidean, mesh).error()[0].code == "place.too-many-repeats");
}

TEST_CASE("a checker on an object is cut along its cells and stays closed", "[place]") {
  scene::Scene scene = default_of("*22222");
  scene::Object ball;
  ball.name = "ball", ball.shape = scene::SphereSpec{0.2};
  ball.material.emplace().pattern = scene::Pattern::checker;
  ball.material->cell = 0.07;
  scene.objects = {ball};
  const Interior room = furnished(scene).value().interior;
  const PlacedMesh& mesh = room.parts.back();
  std::set<std::uint16_t> looks(mesh.style.begin(), mesh.style.end());
  CHECK(looks.size() == 2);
  CHECK(open_edges({mesh}).empty());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    geometry::Vector3 middle;
    for (const std::uint32_t v : mesh.triangles[i]) middle = middle + (1.0 / 3) * mesh.pattern_position[v];
    const double cells = std::floor(middle.x / 0.07) + std::floor(middle.y / 0.07) + std::floor(middle.z / 0.07);
    // Slivers of rounding at the planes aside, each triangle lies in one cell.
    for (const std::uint32_t v : mesh.triangles[i]) {
      const geometry::Vector3 d = 0.999 * (mesh.pattern_position[v] - middle) + middle;
      if (std::floor(d.x / 0.07) + std::floor(d.y / 0.07) + std::floor(d.z / 0.07) != cells) CHECK(length(d - middle) < 1e-6);
    }
    const bool second = room.styles[mesh.style[i]].color.r == room.styles[mesh.style[i]].material.second.r;
    if (std::fabs(middle.x / 0.07 - std::round(middle.x / 0.07)) > 1e-5 &&
        std::fabs(middle.y / 0.07 - std::round(middle.y / 0.07)) > 1e-5 && std::fabs(middle.z / 0.07 - std::round(middle.z / 0.07)) > 1e-5)
      CHECK(second == (std::fmod(cells, 2) != 0));
  }
  scene.objects[0].material->cell = 1e-4;
  CHECK(furnished(scene).error()[0].code == "place.too-many-cells");
}

TEST_CASE("rooms of the plane may have any scale", "[place]") {
  for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
    CAPTURE(scale);
    scene::Scene scene = default_of("*2222");
    scene.room.shape.scale = scale;
    scene.room.height = scale;
    scene.room.floor.material.cell = 0.3 * scale;
    scene.room.walls[0].mirrors[0].arc = {0.5 * scale, 0.75 * scale};
    scene.room.walls[0].mirrors[0].frame.emplace().width = 0.1 * scale;
    scene.room.walls[1].mirrors.clear();
    scene::Object box;
    box.name = "box", box.shape = scene::BoxSpec{{0.3, 0.2, 0.1}}, box.size = 0.4 * scale;
    scene.objects = {box};
    const Interior room = furnished(scene).value().interior;
    REQUIRE(room.parts.size() == 6);
    for (const PlacedMesh& part : room.parts)
      for (const mesh::Triangle& t : part.triangles) CHECK((t[0] != t[1] && t[1] != t[2] && t[2] != t[0]));
    double sum = 0;
    for (const mesh::Triangle& t : room.parts[0].triangles)
      sum += area(room.polygon.space, room.parts[0].floor[t[0]], room.parts[0].floor[t[1]], room.parts[0].floor[t[2]]);
    CHECK(sum == Approx(room.polygon.area));
    CHECK(open_edges({room.parts[5]}).empty());
  }
}

TEST_CASE("the same scene is furnished the same, vertex by vertex", "[place]") {
  scene::Scene scene = default_of("*2323");
  scene.room.walls[1].mirrors[0].frame.emplace();
  const Interior a = furnished(scene).value().interior, b = furnished(scene).value().interior;
  REQUIRE(a.parts.size() == b.parts.size());
  for (std::size_t i = 0; i < a.parts.size(); ++i) {
    CHECK(a.parts[i].triangles == b.parts[i].triangles);
    CHECK(a.parts[i].z == b.parts[i].z);
  }
}
