// No hole anywhere: from random eyes in every kind of room, each pixel of the export sees a triangle wherever a ray through the real
// mirrors meets something before it is cut off. And no T-junction: no vertex of a copy lies within the edge of a triangle that has no
// neighbour there.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <iterator>

#include "compiler/cover/unfold.h"
#include "compiler/driver/threads.h"
#include "view.h"

using namespace orbc;

namespace {

const char* const kFramed[] = {"octant", "triangle", "pentagon"};

/// All rooms of the system tests, and some that are compared in flat colours.
std::vector<std::string> rooms(bool framed) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(ORBC_SOURCE_DIR "/tests/scenes/verify"))
    if (entry.path().extension() == ".yaml") paths.push_back(entry.path());
  const auto flat = [](const char* name) { return std::string(ORBC_SOURCE_DIR "/tests/scenes/flat/") + name + ".yaml"; };
  paths.push_back(flat("strip"));
  if (framed) std::transform(std::begin(kFramed), std::end(kFramed), std::back_inserter(paths), flat);
  std::sort(paths.begin(), paths.end());
  return paths;
}

void look_from(int eyes, unsigned seed) {
  std::mt19937 random(seed);
  const auto paths = rooms(true);
  REQUIRE(paths.size() > 15);
  const Executor executor = driver::parallel_executor();
  int looked = 0, wrong = 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    auto loaded = test::open_or_fail(paths[i]);
    // Fewer bounces make more true holes, and quicker covers; every depth has to be right.
    const int most = std::min(loaded.scene.cover.max_bounces, 5);
    const auto scene = trace::prepare(*loaded.interior);
    const int here =
        eyes * static_cast<int>(i + 1) / static_cast<int>(paths.size()) - eyes * static_cast<int>(i) / static_cast<int>(paths.size());
    for (int n = 0; n < here; ++n, ++looked) {
      loaded.scene.cover.max_bounces = loaded.interior->polygon.space == geometry::Space::spherical ? most + 3 : 1 + n % most;
      test::move_eye(loaded, random, 64, 48);
      driver::CompileOptions options;
      options.bend.tolerance_px = n % 2 ? 0.25 : 0.05;
      const driver::PreparedScene prepared(loaded, {n % 3 != 0});
      const auto compiled = driver::compile(prepared, loaded.eye, options, executor);
      if (!compiled) FAIL(paths[i] + ": " + to_text(compiled.error()));
      const test::Holes found = test::holes(loaded, compiled->product, scene);
      INFO(paths[i] << " eye " << n << " max_bounces " << loaded.scene.cover.max_bounces << ": " << found.first << ", " << found.wrong
                    << " holes");
      CHECK(found.wrong == 0);
      wrong += found.wrong;
    }
  }
  CHECK(looked == eyes);
}

}  // namespace

TEST_CASE("no hole from fifty random eyes", "[watertight]") { look_from(50, 20261); }

TEST_CASE("no hole from a thousand random eyes", "[.][slow]") { look_from(1000, 20262); }

TEST_CASE("a missing triangle is a hole, and a vertex that has moved along its edge tears it", "[watertight]") {
  std::mt19937 random(20264);
  auto loaded = test::open_or_fail(ORBC_SOURCE_DIR "/tests/scenes/verify/pentagon-brick.yaml");
  loaded.scene.cover.max_bounces = 2;
  test::move_eye(loaded, random, 64, 48);
  auto compiled = driver::compile(loaded, {}, serial_executor());
  REQUIRE(compiled);
  const auto copies = cover::unfold(*loaded.interior, loaded.eye, loaded.scene.cover);
  REQUIRE(copies);
  driver::Product torn = compiled->product;
  for (std::size_t i = 0; i + 2 < torn.indices.size(); i += 21) torn.indices[i] = torn.indices[i + 1];
  CHECK(test::holes(loaded, torn, trace::prepare(*loaded.interior)).wrong > 0);
  // The first triangle of the last copy is halved by a vertex that its neighbour does not have.
  int torn_edges = 0;
  for (int k = 0; k < 3; ++k) {
    driver::Product halved = compiled->product;
    driver::ProductCopy& copy = halved.copies.back();
    std::uint32_t* triangle = &halved.indices[copy.first_index];
    const std::uint32_t a = triangle[k], b = triangle[(k + 1) % 3], c = triangle[(k + 2) % 3],
                        middle = static_cast<std::uint32_t>(halved.positions.size());
    std::array<float, 3> at{};
    for (std::size_t i = 0; i < 3; ++i) at[i] = (halved.positions[a][i] + halved.positions[b][i]) / 2;
    triangle[(k + 1) % 3] = middle;
    halved.positions.push_back(at);
    ++copy.vertex_count;
    halved.indices.insert(halved.indices.end(), {middle, b, c});
    copy.index_count += 3;
    torn_edges += test::seams(halved, *copies).torn;
  }
  CHECK(torn_edges > 0);
}

TEST_CASE("no vertex lies within an edge that has no neighbour", "[watertight]") {
  std::mt19937 random(20263);
  for (const std::string& path : rooms(true)) {
    auto loaded = test::open_or_fail(path);
    loaded.scene.cover.max_bounces =
        std::min(loaded.scene.cover.max_bounces, loaded.interior->polygon.space == geometry::Space::spherical ? 6 : 2);
    test::move_eye(loaded, random, 320, 240);
    // A frame is a surface of its own, which stands before its wall and shares no edge with it; its open back meets its mirror image. And
    // bending treats part by part.
    std::vector<std::vector<place::PlacedMesh>> surfaces(1);
    for (const place::PlacedMesh& part : loaded.interior->parts)
      if (part.kind == place::PartKind::frame) surfaces.push_back({part});
      else surfaces.front().push_back(part);
    for (const auto& surface : surfaces) {
      auto alone = *loaded.interior;
      alone.parts = surface;
      loaded.interior = std::make_shared<const place::Interior>(std::move(alone));
      const auto compiled = driver::compile(loaded, {}, serial_executor());
      REQUIRE(compiled);
      const auto copies = cover::unfold(*loaded.interior, loaded.eye, loaded.scene.cover);
      REQUIRE(copies);
      REQUIRE(copies->size() == compiled->product.copies.size());
      const test::Seams found = test::seams(compiled->product, *copies);
      INFO(path << ", " << surface.front().name << ": " << found.torn << " of " << found.edges << ": " << found.first);
      CHECK(found.torn == 0);
    }
  }
}
