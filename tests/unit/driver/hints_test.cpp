// Every hint that names a value is taken: the scene that failed is changed as its hint says, and must pass.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <regex>

#include "compiler/driver/compile.h"
#include "compiler/driver/fitting_bounces.h"
#include "compiler/driver/threads.h"
#include "compiler/notation/enumerate.h"
#include "compiler/notation/parse.h"

using namespace orbc;

namespace {

enum class Stage { open, compile, plan };

/// A scene with @ in the place of a value, the value that fails, and where the hint names a better one: the group of a pattern.
struct HintCase {
  const char* name;
  const char* scene;
  const char* bad;
  const char* code;
  const char* hint;
  Stage stage = Stage::open;
  std::function<void(driver::CompileOptions&, const std::string&)> option{};  ///< takes the value instead of the scene
};

std::string with_value(std::string scene, const std::string& value) {
  for (std::size_t at; (at = scene.find('@')) != std::string::npos;) scene.replace(at, 1, value);
  return scene;
}

Diagnostics faults_of(const HintCase& c, const std::string& value, const std::filesystem::path& folder) {
  const std::string path = (folder / "scene.yaml").string();
  std::ofstream(path) << (c.option ? std::string(c.scene) : with_value(c.scene, value));
  const auto loaded = driver::load(path);
  if (!loaded) return loaded.error();
  if (c.stage == Stage::open) {
    Diagnostics warnings;
    std::copy_if(loaded->notes.begin(), loaded->notes.end(), std::back_inserter(warnings),
                 [](const Diagnostic& d) { return d.severity != Severity::note; });
    return warnings;
  }
  driver::CompileOptions options;
  options.highlights = false;
  options.max_memory = std::uint64_t{64} << 20;
  if (c.option) c.option(options, value);
  const Executor executor = driver::parallel_executor();
  if (c.stage == Stage::plan) {
    const auto planned = driver::plan(*loaded, options, executor);
    return planned ? Diagnostics{} : planned.error();
  }
  const auto compiled = driver::compile(*loaded, options, executor);
  return compiled ? Diagnostics{} : compiled.error();
}

constexpr const char* kPentagon = "orbc: 1\norbifold: \"*22222\"\n";
constexpr const char* kBounces = "^max_bounces: (\\d+) fits$";

const HintCase kHints[] = {
    {"an object too large for its place",
     "orbc: 1\norbifold: \"*22222\"\nobjects: [{sphere: {radius: 0.4}, size: @, at: {polar: [0.2, 20deg]}}]\n"
     "camera: {at: {polar: [0.05, 0deg], z: 0.97}, look_at: {azimuth: 0deg, elevation: -10deg}}\n",
     "0.9", "place.object-outside-room", "^`size: ([0-9.]+)` fits here$"},
    {"an object too large for a corner", "orbc: 1\norbifold: \"*235\"\nobjects: [{box: {size: [0.2, 0.1, 0.1]}, size: @}]\n", "0.5",
     "place.object-outside-room", "^`size: ([0-9.]+)` fits here$"},
    {"an object too high for a sphere's room",
     "orbc: 1\norbifold: \"*222\"\nroom: {height: 0.5}\nobjects: [{cylinder: {radius: 0.3, height: 0.9}, size: @}]\n"
     "camera: {at: {polar: [0.4, 90deg]}}\n",
     "0.6", "place.object-outside-room", "^`size: ([0-9.]+)` fits here$"},
    {"an object close to a wall", "orbc: 1\norbifold: \"*333\"\nobjects: [{torus: {radius: 0.5, tube: 0.1}, @}]\n",
     "size: 2.6, at: {toward: wall 1, distance: 0.95}", "place.object-outside-room", "^`(size: [0-9.]+)` fits at the centre of the room$"},
    {"a camera outside of the room", "orbc: 1\norbifold: \"*22222\"\ncamera: {at: {polar: [@, 40deg]}}\n", "3", "place.eye-outside-room",
     "the room ends at ([0-9.]+)$"},
    {"cells of a floor", "orbc: 1\norbifold: \"*2222\"\nroom: {floor: {checker: [white, black], cell: @}}\n", "0.0001",
     "place.too-many-cells", "^a cell of ([0-9.e-]+) fits$"},
    {"cells of a wall", "orbc: 1\norbifold: \"*2222\"\nroom: {walls: {1: {mirror: none, checker: [white, black], cell: @}}}\n", "0.0001",
     "place.too-many-cells", "^a cell of ([0-9.e-]+) fits$"},
    {"images of lamps",
     "orbc: 1\norbifold: \"*23456789(10)(11)\"\nlights: [{at: {polar: [0.1, 0deg]}, radius: 0.01, power: 1000}]\nbake: {mirrors: @}\n",
     "12", "light.too-many-images", "^`bake: \\{mirrors: (\\d+)\\}` has few enough$"},
    {"a stretched panorama", "orbc: 1\norbifold: \"*2222\"\ncamera: {projection: panorama, size: @}\n", "[400, 300]", "scene.stretched",
     "size: (\\[\\d+, \\d+\\])"},
    {"a corner that is no integer", "orbc: 1\norbifold: \"*(3/2)(12)(12)\"\n@\n", "", "notation.non-orbifold-corner",
     "(allow_non_orbifold: true)$"},
    {"a single corner", "orbc: 1\norbifold: \"@\"\n", "*7", "notation.bad-orbifold", "two equal corners are (\\S+)$"},
    {"two corners that differ", "orbc: 1\norbifold: \"@\"\n", "*23", "notation.bad-orbifold", "the same order: (\\S+) or"},
    {"gyration points", "orbc: 1\norbifold: \"@\"\n", "237", "notation.not-kaleidoscopic", "^with mirrors it is (\\S+)$"},
    {"a word that nearly is a colour", "orbc: 1\norbifold: \"*2222\"\nroom: {floor: {color: @}}\n", "slatgray", "scene.bad-color",
     "did you mean `(\\w+)`"},
    {"a version that there is not", "orbc: @\norbifold: \"*2222\"\n", "3", "scene.wrong-version", "write `orbc: (\\d)`"},
    {"copies of many bounces", "orbc: 1\norbifold: \"*22222\"\ncover: {max_bounces: @}\n", "40", "cover.too-much", kBounces,
     Stage::compile},
    {"a plan of many bounces", "orbc: 1\norbifold: \"*22222\"\ncover: {max_bounces: @}\n", "11", "cover.too-much", kBounces, Stage::plan},
    {"copies of many bounces on storeys",
     "orbc: 1\norbifold: \"*2222\"\nroom: {floor: {mirror: {}}, ceiling: {mirror: {}}}\ncover: {max_bounces: @}\n", "900", "cover.too-much",
     kBounces, Stage::compile},
    {"copies of a large flat room", "orbc: 1\norbifold: \"*2222\"\ncover: {max_bounces: @}\n", "900", "cover.too-much", kBounces,
     Stage::compile},
    {"copies behind plain walls", "orbc: 1\norbifold: \"*22222\"\nroom: {walls: {2: {mirror: none}}}\ncover: {max_bounces: @}\n", "40",
     "cover.too-much", kBounces, Stage::compile},
    {"beams of a room with real corners",
     "orbc: 1\norbifold: \"*(2.5)(2.5)(2.5)(2.5)(2.5)\"\nallow_non_orbifold: true\ncover: {max_bounces: @}\n", "12", "cover.too-much",
     kBounces, Stage::compile},
    {"beams of mirrors that differ",
     "orbc: 1\norbifold: \"*22222\"\nroom: {walls: {2: {mirror: {reflectance: 0.5}}}}\ncover: {max_bounces: @}\n", "14", "cover.too-much",
     kBounces, Stage::compile},
    {"a tolerance", kPentagon, "0.001", "bend.too-dense", "^a tolerance of ([0-9.e+-]+) px fits$", Stage::compile,
     [](driver::CompileOptions& options, const std::string& value) {
       options.bend.max_triangles = 200'000;
       options.max_memory = std::uint64_t{4} << 30;
       options.bend.tolerance_px = std::strtod(value.c_str(), nullptr);
     }},
    {"a budget of triangles", kPentagon, "20", "bend.too-dense", "--max-triangles (\\d+) fits$", Stage::compile,
     [](driver::CompileOptions& options, const std::string& value) { options.budget = std::strtoull(value.c_str(), nullptr, 10); }},
};

}  // namespace

TEST_CASE("each hint that names a value is taken, and works", "[driver][long]") {
  std::string name = (std::filesystem::temp_directory_path() / "orbc-hints.XXXXXX").string();
  REQUIRE(mkdtemp(name.data()));
  for (const HintCase& c : kHints) {
    const Diagnostics failed = faults_of(c, c.bad, name);
    INFO(c.name << ": " << to_text(failed));
    const auto fault = std::find_if(failed.begin(), failed.end(), [&](const Diagnostic& d) { return d.code == c.code; });
    CHECK(fault != failed.end());
    if (fault == failed.end()) continue;
    std::smatch found;
    const bool named = std::regex_search(fault->hint, found, std::regex(c.hint));
    CHECK(named);
    if (!named) continue;
    const std::string value = found[1];
    const Diagnostics after = faults_of(c, value, name);
    INFO("with " << value << ": " << to_text(after));
    CHECK(after.empty());
  }
  std::filesystem::remove_all(name);
}

TEST_CASE("the most bounces are found by halving, whatever is guessed first", "[driver]") {
  for (int most = -1; most < 20; ++most)
    for (int guess : {0, 5, 19, 40}) {
      int tried = 0;
      const auto found = driver::max_fitting_bounces(20, guess, [&](int bounces) {
        ++tried;
        return bounces <= most;
      });
      CHECK(found.value_or(-1) == most);
      CHECK(tried <= 7);
    }
}
