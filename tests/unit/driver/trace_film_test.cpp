// Pictures in which matte light is interpolated against pictures that ask every lamp at every sample.
#include "compiler/driver/trace_film.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

using namespace orbc;

namespace {

driver::LoadedScene film_room(const std::string& orbifold) {
  const auto path = std::filesystem::temp_directory_path() / ("orbc-trace-film-" + std::to_string(getpid()) + ".yaml");
  std::ofstream(path) << "orbc: 1\norbifold: \"" + orbifold +
                             "\"\nroom:\n  height: 0.9\n  floor: {checker: [ivory, slategray], cell: 0.2}\n"
                             "  walls: {all: {mirror: {reflectance: 0.9}, frame: {width: 0.05, color: goldenrod}}}\n"
                             "objects:\n  - {torus_knot: {p: 2, q: 3, radius: 0.08, tube: 0.03}, at: {polar: [0.14, 80deg], z: 0.2}}\n"
                             "  - {sphere: {radius: 0.08}, at: {polar: [0.2, 350deg]}, material: glass}\n"
                             "lights:\n  - {kind: sphere, at: {polar: [0.25, 330deg], z: 0.7}, radius: 0.035, power: 6}\n"
                             "ambient: \"#303030\"\ncamera: {at: {polar: [0.4, 222deg], z: 0.42}, look_at: {polar: [0.1, 42deg], z: 0.3}, "
                             "fov: 80deg, size: [96, 72]}\ncover: {max_bounces: 3}\n";
  auto done = driver::load(path.string());
  std::filesystem::remove(path);
  REQUIRE(done);
  return std::move(done).value();
}

/// Root mean square of the differences of two pictures, and how many pixels differ by more than 10, in steps of 1/255.
struct Apart {
  double rms = 0;
  int far_off = 0;
};
Apart apart(const image::Image& a, const image::Image& b) {
  Apart result;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    int worst = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const int off = std::abs(int{a.rgba[i + c]} - int{b.rgba[i + c]});
      result.rms += off * off;
      worst = std::max(worst, off);
    }
    result.far_off += worst > 10;
  }
  result.rms = std::sqrt(result.rms / (0.75 * static_cast<double>(a.rgba.size())));
  return result;
}

}  // namespace

TEST_CASE("pictures with interpolated light differ from exact ones by less than a step of 8 bits", "[driver]") {
  const driver::LoadedScene scene = film_room(GENERATE("*222", "*333", "*22222"));
  const int samples = GENERATE(1, 4);
  const auto drawn = [&](bool exact) {
    return render::to_image(driver::trace_film(scene, {.samples = samples, .exact = exact}, serial_executor()), scene.scene.exposure);
  };
  const image::Image exact = drawn(true), fast = drawn(false);
  const Apart off = apart(exact, fast);
  INFO("rms " << off.rms << ", " << off.far_off << " pixels by more than 10");
  CHECK(exact.rgba != fast.rgba);  // they are not the same computation
  CHECK(off.rms < 0.6);
  CHECK(off.far_off <= 7);  // 0.1 % of the picture
}

TEST_CASE("interpolated light gives the same picture for any executor", "[driver]") {
  const driver::LoadedScene scene = film_room("*22222");
  const Executor backwards = [](std::size_t count, const std::function<void(std::size_t)>& task) {
    for (std::size_t i = count; i-- > 0;) task(i);
  };
  CHECK(render::to_image(driver::trace_film(scene, {}, backwards)).rgba ==
        render::to_image(driver::trace_film(scene, {}, serial_executor())).rgba);
}

TEST_CASE("a stereo panorama of a flat room does not depend on the author's unit of length", "[driver]") {
  const auto drawn = [](const std::string& text) {
    const auto loaded = driver::load(scene::SceneText{std::make_shared<const SourceText>(SourceText{"stereo.yaml", text}), ""});
    REQUIRE(loaded);
    return render::to_image(driver::trace_film(*loaded, {}, serial_executor())).rgba;
  };
  const auto room = [](const char* scale, const char* place, const char* separation) {
    return fmt::format(
        "orbc: 1\norbifold: \"*2222\"\nroom: {{scale: {0}, height: {0}, floor: {{checker: [ivory, slategray], cell: {1}}}}}\n"
        "camera: {{projection: stereo{2}, at: {{xy: [{1}, 0]}}, look_at: {{azimuth: 0, elevation: 0}}, size: [24, 24]}}\n"
        "cover: {{max_bounces: 2}}\n",
        scale, place, separation);
  };
  CHECK(drawn(room("1", "0.25", ", eye_separation: 0.125")) == drawn(room("4", "1", ", eye_separation: 0.5")));
  CHECK(drawn(room("1", "0.25", "")) == drawn(room("4", "1", "")));
  CHECK(drawn(room("1", "0.25", "")) != drawn(room("1", "0.25", ", eye_separation: 0.125")));
}

TEST_CASE("a picture to a noise target is off from one of many samples by that at most, where few samples are not", "[driver]") {
  driver::LoadedScene scene = film_room("*22222");
  const driver::PreparedScene prepared(scene);
  const double exposure = scene.scene.exposure;
  std::vector<int> passes;
  double mean_samples = 0, unsettled = 1;
  const auto note_pass = [&](const driver::FilmPass& pass) {
    passes.push_back(pass.samples);
    mean_samples = pass.mean_samples;
    unsettled = pass.unsettled;
    CHECK(pass.film.color.size() == 96U * 72U);
  };
  const auto to_noise = [&](double noise, int most) {
    passes.clear();
    return render::to_image(driver::trace_to_noise(prepared, scene.eye, {noise, most}, serial_executor(), note_pass), exposure);
  };
  const image::Image many = render::to_image(driver::trace_film(prepared, scene.eye, {.samples = 1024}, serial_executor()), exposure);
  const auto beyond = [&](const image::Image& image, int steps) {
    int count = 0;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
      int worst = 0;
      for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::abs(int{image.rgba[i + c]} - int{many.rgba[i + c]}));
      count += worst > steps;
    }
    return count / (96.0 * 72.0);
  };
  const image::Image smooth = to_noise(6.0 / 255, 256);
  CHECK(passes == std::vector<int>{1, 4, 16, 64, 256});
  CHECK(beyond(smooth, 6) < 0.01);
  CHECK(mean_samples < 200);  // most of it was not drawn again and again
  CHECK(beyond(render::to_image(driver::trace_film(prepared, scene.eye, {.samples = 4}, serial_executor()), exposure), 6) > 0.1);
  // The least that is allowed is one pass, and a loose target is met early.
  (void)to_noise(1.0 / 255, 1);
  CHECK(passes == std::vector<int>{1});
  (void)to_noise(1, 256);
  CHECK(passes == std::vector<int>{1, 4});
  CHECK(unsettled == 0);
}
