// The planner against what is made: of every room of the system tests, in full and from few of its copies.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "compiler/bake/atlas.h"
#include "compiler/cover/unfold.h"
#include "compiler/driver/compile.h"
#include "compiler/driver/threads.h"
#include "compiler/lod/estimate.h"

using namespace orbc;

namespace {

std::vector<std::string> rooms() {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(ORBC_SOURCE_DIR "/tests/scenes/verify"))
    if (entry.path().extension() == ".yaml") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

driver::LoadedScene open_or_fail(const std::string& path) {
  auto loaded = driver::load(path);
  if (!loaded) FAIL(path + ": " + to_text(loaded.error()));
  return std::move(loaded).value();
}

double bytes_of(std::size_t vertices, std::size_t triangles, std::size_t copies) {
  return cover::kBytesPerVertex * static_cast<double>(vertices) + cover::kBytesPerTriangle * static_cast<double>(triangles) +
         cover::kBytesPerCopy * static_cast<double>(copies);
}

bool near(std::uint64_t planned, double real) { return std::fabs(static_cast<double>(planned) / real - 1) <= 0.2; }

}  // namespace

TEST_CASE("the plan foresees copies exactly, and triangles, vertices and bytes within a fifth", "[driver][long]") {
  const Executor executor = driver::parallel_executor();
  for (const std::string& path : rooms()) {
    const auto loaded = open_or_fail(path);
    const auto planned = driver::plan(loaded, {}, executor);
    const auto compiled = driver::compile(loaded, {}, executor);
    REQUIRE(planned);
    REQUIRE(compiled);
    const driver::Report& r = compiled->report;
    INFO(path << ": " << planned->triangles << " planned, " << r.triangles << " made");
    CHECK(planned->copies == r.copies);
    CHECK(near(planned->triangles, static_cast<double>(r.triangles)));
    CHECK(near(planned->vertices, static_cast<double>(r.vertices)));
    CHECK(near(planned->bytes, bytes_of(r.vertices, r.triangles, r.copies)));
  }
}

TEST_CASE("the plan foresees panels and budgets as well", "[driver][long]") {
  const Executor executor = driver::parallel_executor();
  const int which = GENERATE(0, 1, 2, 3);
  auto loaded =
      open_or_fail(std::string(ORBC_SOURCE_DIR) + (which == 3 ? "/tests/scenes/verify/pentagon-brick.yaml" : "/tests/bench/scale.yaml"));
  driver::CompileOptions options;
  loaded.scene.cover.max_bounces = which == 3 ? 4 : 34;
  loaded.scene.cover.min_pixels = which == 2 ? 0 : 3;
  if (which == 1) loaded.scene.cover.background_expected = true;
  if (which >= 2) options.budget = 60'000;
  const auto planned = driver::plan(loaded, options, executor);
  const auto compiled = driver::compile(loaded, options, executor);
  REQUIRE(planned);
  REQUIRE(compiled);
  const driver::Report& r = compiled->report;
  INFO(which << ": " << planned->triangles << " planned, " << r.triangles << " made, " << r.impostors << " panels");
  CHECK(planned->copies == r.copies);
  CHECK(near(planned->triangles, static_cast<double>(r.triangles)));
  CHECK(near(planned->vertices, static_cast<double>(r.vertices)));
  if (which < 2) CHECK(r.impostors > 0);
  if (options.budget) CHECK(r.triangles <= *options.budget);
  // What a budget left out is said.
  const bool said = std::any_of(compiled->notes.begin(), compiled->notes.end(),
                                [](const Diagnostic& note) { return note.code == "driver.copies-left-out"; });
  CHECK(said == (r.culled > 0));
  if (r.culled > 0) CHECK((r.impostors > 0 || r.impostors_dropped));
}

TEST_CASE("few copies tell of all", "[driver][long]") {
  const Executor executor = driver::parallel_executor();
  for (const std::string& path : rooms()) {
    const auto loaded = open_or_fail(path);
    const auto copies = cover::unfold(*loaded.interior, loaded.eye, loaded.scene.cover);
    const auto atlas = bake::make_atlas(*loaded.interior);
    REQUIRE((copies && atlas));
    std::size_t bent_copies = 0;
    const auto bend_some = [&](const std::vector<std::size_t>& which) {
      std::vector<cover::Copy> some;
      for (const std::size_t i : which) some.push_back((*copies)[i]);
      bent_copies = some.size();
      const std::array models{bend::whole_model(atlas->room, atlas->uv)};
      return bend::bend(atlas->room, {some, models, {}}, loaded.eye, {}, executor);
    };
    const auto planned = lod::estimate(cover::contents_of(*loaded.interior), loaded.eye, *copies, bend_some,
                                       {loaded.scene.cover.max_bounces, ~std::uint64_t{0}, 1});
    REQUIRE(planned);
    CHECK(bent_copies <= 129);
    std::vector<std::size_t> all(copies->size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    const auto bent = bend_some(all);
    REQUIRE(bent);
    INFO(path << ": " << copies->size() << " copies, " << planned->triangles << " planned, " << bent->indices.size() / 3 << " made");
    CHECK(near(planned->triangles, static_cast<double>(bent->indices.size()) / 3));
    CHECK(near(planned->vertices, static_cast<double>(bent->positions.size())));
  }
}

TEST_CASE("what exceeds the memory is refused, what fits is not", "[driver]") {
  const auto loaded = open_or_fail(ORBC_SOURCE_DIR "/tests/scenes/verify/pentagon-brick.yaml");
  driver::CompileOptions options;
  const auto whole = driver::compile(loaded, options, serial_executor());
  REQUIRE(whole);
  const double bytes = bytes_of(whole->report.vertices, whole->report.triangles, whole->report.copies);
  options.max_memory = static_cast<std::uint64_t>(2 * 0.8 * bytes);
  const auto refused = driver::compile(loaded, options, serial_executor());
  REQUIRE(!refused);
  CHECK(refused.error().front().code == "cover.too-much");
  CHECK(refused.error().front().hint == "max_bounces: 4 fits");
  options.max_memory = static_cast<std::uint64_t>(2 * 1.2 * bytes);
  CHECK(driver::compile(loaded, options, serial_executor()));
}
