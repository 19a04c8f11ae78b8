// A prepared scene is compiled for several eyes: what no eye changes is made for the first alone, and each gets its own product.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <set>

#include "compiler/driver/compile.h"
#include "compiler/driver/trace_film.h"

using namespace orbc;

namespace {

driver::LoadedScene room_with_knot(const std::string& more) {
  const auto path = std::filesystem::temp_directory_path() / ("orbc-second-eye-" + std::to_string(getpid()) + ".yaml");
  std::ofstream(path) << "orbc: 1\norbifold: \"*22222\"\nroom: {height: 0.9}\nobjects:\n"
                         "  - {torus_knot: {p: 2, q: 3, radius: 0.09, tube: 0.03}, at: {polar: [0.2, 200deg], z: 0.15}, material: coral}\n"
                         "camera: {at: {polar: [0.3, 40deg], z: 0.45}, size: [60, 45]}\n"
                         "cover: {max_bounces: 2, background: \"#20242c\"}\nbake: {quality: draft}\n"
                      << more;
  auto loaded = driver::load(path.string());
  std::filesystem::remove(path);
  if (!loaded) FAIL(to_text(loaded.error()));
  return std::move(loaded).value();
}

place::Camera moved_eye(const driver::LoadedScene& loaded) {
  scene::Scene scene = loaded.scene;
  scene.camera.place.floor = scene::AtPolar{0.35, Angle::from_degrees(100)};
  scene.camera.place.z = 0.6;
  return place::make_camera(scene, *loaded.interior).value();
}

/// Records the names of the stages that report progress.
struct Stages {
  std::set<std::string> names;
  [[nodiscard]] Progress progress() {
    Progress progress;
    progress.report = [this](std::string_view stage, std::uint64_t, std::uint64_t, std::string_view) { names.emplace(stage); };
    return progress;
  }
  [[nodiscard]] bool has(const std::string& stage) const { return names.count(stage) > 0; }
};

void check_equal(const driver::Product& a, const driver::Product& b) {
  CHECK(a.positions == b.positions);
  CHECK(a.uv == b.uv);
  CHECK(a.indices == b.indices);
  CHECK(a.atlas.rgba == b.atlas.rgba);
}

constexpr const char* kLamp = "lights: [{kind: sphere, at: {polar: [0.05, 40deg], z: 0.7}, radius: 0.05, power: 4}]\n";
// Stages that no eye changes.
const std::set<std::string> kEyeFree{"levels of detail", "preparing", "baking", "passing light on"};

}  // namespace

TEST_CASE("compiling for a second eye repeats nothing that knows no eye", "[driver]") {
  for (const std::string& more : {std::string(kLamp), kLamp + std::string("integrator: path\n"), std::string()}) {
    CAPTURE(more);
    const driver::PreparedScene scene(room_with_knot(more));
    const place::Camera first = scene.loaded().eye, second = moved_eye(scene.loaded());
    Stages of_first, of_second;
    REQUIRE(driver::compile(scene, first, {}, serial_executor(), of_first.progress()));
    CHECK(of_first.has("levels of detail"));
    CHECK(of_first.has("baking") == scene.is_baked());
    const auto compiled = driver::compile(scene, second, {}, serial_executor(), of_second.progress());
    REQUIRE(compiled);
    CHECK(of_second.has("unfolding"));
    for (const std::string& stage : kEyeFree) {
      CAPTURE(stage);
      CHECK_FALSE(of_second.has(stage));
    }
    // The second picture is that of the second eye alone.
    const driver::PreparedScene fresh(room_with_knot(more));
    const auto alone = driver::compile(fresh, second, {}, serial_executor());
    REQUIRE(alone);
    check_equal(compiled->product, alone->product);
  }
}

TEST_CASE("a budget is met without baking twice", "[driver]") {
  const driver::PreparedScene scene(room_with_knot(kLamp));
  driver::CompileOptions options;
  options.budget = 20'000;
  int bakes = 0;
  std::string last;
  Progress progress;
  progress.report = [&](std::string_view stage, std::uint64_t, std::uint64_t, std::string_view) {
    bakes += stage == "baking" && last != "baking";
    last = stage;
  };
  const auto compiled = driver::compile(scene, scene.loaded().eye, options, serial_executor(), progress);
  REQUIRE(compiled);
  CHECK(compiled->report.triangles <= *options.budget);
  CHECK(bakes == 1);
}

TEST_CASE("tracing and compiling share tracer and light", "[driver]") {
  const driver::PreparedScene scene(room_with_knot(kLamp));
  Stages traced, compiled;
  (void)driver::trace_film(scene, scene.loaded().eye, {}, serial_executor(), traced.progress());
  CHECK(traced.has("preparing"));
  REQUIRE(driver::compile(scene, scene.loaded().eye, {}, serial_executor(), compiled.progress()));
  CHECK_FALSE(compiled.has("preparing"));
}
