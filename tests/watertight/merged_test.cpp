// Copies too small to be drawn one by one: a panel in the mirror through which they are seen stands for them, so that the picture neither
// has holes nor another colour there.
#include <catch2/catch.hpp>
#include <cmath>

#include "compiler/driver/threads.h"
#include "compiler/driver/trace_film.h"
#include "compiler/image/srgb.h"
#include "view.h"

using namespace orbc;

namespace {

struct Difference {
  double mean = 0;    ///< of all channels, in steps of 1/255
  double smooth = 0;  ///< the same of means over 5×5 pixels: fine patterns alias, and no panel does
};

/// Encoded 0 … 255, means over (2r + 1)² pixels.
std::vector<std::array<double, 3>> smoothed(const std::vector<scene::Color>& picture, int width, int r) {
  const int height = static_cast<int>(picture.size()) / width;
  std::vector<std::array<double, 3>> means(picture.size());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      int count = 0;
      auto& mean = means[static_cast<std::size_t>(y * width + x)];
      for (int j = std::max(0, y - r); j <= std::min(height - 1, y + r); ++j)
        for (int i = std::max(0, x - r); i <= std::min(width - 1, x + r); ++i, ++count) {
          const scene::Color& c = picture[static_cast<std::size_t>(j * width + i)];
          mean[0] += 255 * image::encode_srgb(c.r), mean[1] += 255 * image::encode_srgb(c.g), mean[2] += 255 * image::encode_srgb(c.b);
        }
      for (double& channel : mean) channel /= count;
    }
  return means;
}

double mean_difference(const std::vector<scene::Color>& a, const std::vector<scene::Color>& b, int width, int r) {
  const auto p = smoothed(a, width, r), q = smoothed(b, width, r);
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) sum += std::fabs(p[i][k] - q[i][k]) / 3;
  return sum / static_cast<double>(p.size());
}

Difference difference(const std::vector<scene::Color>& a, const std::vector<scene::Color>& b, int width) {
  return {mean_difference(a, b, width, 0), mean_difference(a, b, width, 2)};
}

driver::LoadedScene open(const char* path, int max_bounces) {
  auto loaded = test::open_or_fail(std::string(ORBC_SOURCE_DIR "/") + path);
  loaded.scene.cover.max_bounces = max_bounces;
  loaded.scene.camera.size = {200, 150};
  loaded.eye = place::make_camera(loaded.scene, *loaded.interior).value();
  return loaded;
}

}  // namespace

TEST_CASE("copies below some pixels are merged, not lost", "[watertight]") {
  // Deep enough that what is merged matters: an orbifold by the group, rooms that go by beams.
  struct Case {
    const char* path;
    int max_bounces;
    double error;  ///< mean, steps of 1/255
  };
  const Case c = GENERATE(Case{"tests/bench/scale.yaml", 40, 0.8}, Case{"tests/scenes/verify/triangle-unequal.yaml", 40, 0.2});
  auto loaded = open(c.path, c.max_bounces);
  // Seen at 0.97^40 it is as dark as what is around it: near black, steps of sRGB are small.
  loaded.scene.cover.background = {0.049, 0.060, 0.085};
  const Executor executor = driver::parallel_executor();
  const std::vector<scene::Color> truth = driver::trace_film(loaded, {}, executor).color;
  std::uint64_t copies = ~std::uint64_t{0};
  for (const double pixels : {0.0, 1.0, 2.0, 3.0}) {
    loaded.scene.cover.min_pixels = pixels;
    const auto compiled = driver::compile(loaded, {}, executor);
    REQUIRE(compiled);
    const Difference off = difference(test::picture(compiled->product), truth, loaded.eye.width);
    const driver::Report& r = compiled->report;
    INFO(c.path << ", min_pixels " << pixels << ": " << r.copies << " copies, " << r.impostors << " curtains, weight " << r.weight_culled
                << ", mean " << off.mean << ", smooth " << off.smooth);
    CHECK(r.impostors > 0);  // where paths are cut off, and where copies are left out
    CHECK((r.weight_culled > 0) == (pixels > 0 && r.copies < copies));
    CHECK(off.smooth < c.error);
    CHECK(off.mean < 2 * c.error);
    // Holes would cost as much as what was to be seen there.
    if (r.weight_culled > 0.01) CHECK(off.smooth < 0.3 * 255 * r.weight_culled);
    CHECK(r.copies <= copies);
    if (pixels == 0) copies = r.copies;
  }
}

TEST_CASE("closed rooms stay closed when copies are merged", "[watertight]") {
  const char* const path = GENERATE("tests/scenes/verify/square-one.yaml", "tests/scenes/verify/square-adjacent.yaml",
                                    "tests/scenes/verify/pentagon-brick.yaml", "tests/bench/scale.yaml");
  auto loaded = open(path, 30);
  const auto scene = trace::prepare(*loaded.interior);
  std::mt19937 random(20265);
  for (int n = 0; n < 4; ++n) {
    loaded.scene.cover.min_pixels = 4.0 + 10 * n;
    test::move_eye(loaded, random, 100, 75);
    const Executor executor = driver::parallel_executor();
    auto compiled = driver::compile(loaded, {}, executor);
    REQUIRE(compiled);
    if (n == 3) {
      driver::CompileOptions less;
      less.budget = compiled->report.triangles * 2 / 3;
      compiled = driver::compile(loaded, less, executor);
      REQUIRE(compiled);
      CHECK(compiled->report.triangles <= *less.budget);
    }
    const test::Holes found = test::holes(loaded, compiled->product, scene);
    INFO(path << " min_pixels " << loaded.scene.cover.min_pixels << ": " << compiled->report.copies << " copies, "
              << compiled->report.impostors << " curtains, " << found.first << ", tolerance " << compiled->report.tolerance_px
              << " curtains dropped " << compiled->report.impostors_dropped);
    CHECK(found.wrong == 0);
  }
}
