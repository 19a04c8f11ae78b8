// Exposure has one meaning in both roads, with light and without.
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "compiler/driver/compile.h"
#include "compiler/driver/trace_film.h"
#include "compiler/image/image.h"
#include "compiler/image/srgb.h"

using namespace orbc;

namespace {

driver::LoadedScene loaded(const std::string& more) {
  const auto path = std::filesystem::temp_directory_path() / ("orbc-exposure-" + std::to_string(getpid()) + ".yaml");
  std::ofstream(path) << "orbc: 1\norbifold: \"*2222\"\nroom: {floor: {color: \"#b0b0b0\"}, ceiling: {color: \"#b0b0b0\"}, walls: {all: "
                         "{mirror: none, color: \"#b0b0b0\"}}}\n"
                         "camera: {at: {z: 0.45}, size: [8, 6]}\n" +
                             more;
  auto done = driver::load(path.string());
  std::filesystem::remove(path);
  REQUIRE(done);
  return std::move(done).value();
}

int traced(const driver::LoadedScene& scene) {
  const image::Image image = render::to_image(driver::trace_film(scene, {}, serial_executor()), scene.scene.exposure);
  return image.rgba[4 * (3 * 8 + 4)];
}

/// Whether a good share of the vertices refers to that colour of the atlas.
bool exports(const driver::LoadedScene& scene, int expected) {
  const driver::Product product = driver::compile(scene, {}, serial_executor()).value().product;
  std::size_t count = 0;
  for (const auto& uv : product.uv) {
    const auto x = static_cast<std::size_t>(uv[0] * static_cast<float>(product.atlas.width)),
               y = static_cast<std::size_t>(uv[1] * static_cast<float>(product.atlas.height));
    count += product.atlas.rgba[4 * (y * static_cast<std::size_t>(product.atlas.width) + x)] == expected;
  }
  return count * 20 > product.uv.size();
}

}  // namespace

TEST_CASE("exposure means the same in both roads, in scenes without light too", "[driver]") {
  const double linear = image::decode_srgb(0xb0 / 255.0);
  for (const double exposure : {0.5, 1.0, 1.5, 4.0}) {
    const int expected = static_cast<int>(std::lround(255 * image::encode_srgb(std::min(1.0, exposure * linear))));
    const std::string plain = "exposure: " + std::to_string(exposure) + "\n";
    CAPTURE(exposure, expected);
    CHECK(traced(loaded(plain)) == expected);
    CHECK(exports(loaded(plain), expected));
    // A glass ball has light worked out for the atlas, though there is none.
    const std::string ball = plain + "objects: [{box: {size: [0.02, 0.02, 0.02]}, at: {polar: [0.3, 200deg]}, material: glass}]\n";
    CHECK(traced(loaded(ball)) == expected);
    CHECK(exports(loaded(ball), expected));
  }
}

TEST_CASE("light above white is dimmed by mirrors before pictures cut it off, in both roads", "[driver]") {
  const auto path = std::filesystem::temp_directory_path() / ("orbc-above-white-" + std::to_string(getpid()) + ".yaml");
  std::ofstream(path)
      << "orbc: 1\norbifold: \"*2222\"\nroom: {floor: {material: {kind: emissive, emission: 12.4, color: white}}, ceiling: "
         "{color: black}, walls: {all: {mirror: {reflectance: 0.5}}}}\nlights: [{kind: point, at: {z: 0.5}, power: 0.001}]\n"
         "camera: {at: {z: 0.45}, size: [64, 48]}\ncover: {max_bounces: 7}\n";
  const auto scene = driver::load(path.string());
  std::filesystem::remove(path);
  REQUIRE(scene);
  const render::Film film = driver::trace_film(*scene, {}, serial_executor());
  const image::Image picture = render::to_image(film, scene->scene.exposure);
  int seen = 0;
  for (std::size_t i = 0; i < film.color.size(); ++i) {
    if (film.color[i].g < 1e-3) continue;  // the ceiling
    const double expected = 12.4 * std::pow(0.5, film.bounces[i]);
    CHECK(film.color[i].g == Approx(expected));
    CHECK(picture.rgba[4 * i + 1] == image::encode_srgb8(std::min(1.0, expected)));
    seen |= 1 << film.bounces[i];
  }
  CHECK((seen & 0b11110) == 0b11110);  // one to four mirrors: 6.2, 3.1, 1.55 and 0.775
  CHECK(render::clipped_share(film, 1) > 0.1);
  // Exports: white where it is still above white in the mirror, and else the dimmed light itself.
  const driver::Product product = driver::compile(*scene, {}, serial_executor()).value().product;
  int dimmed = 0;
  for (const driver::ProductCopy& copy : product.copies) {
    if (copy.vertex_count == 0 || !copy.duplicate_of) continue;
    const driver::ProductCopy& whole = product.copies[*copy.duplicate_of];
    const double expected = std::min(1.0, 12.4 * whole.weight.g);
    CHECK(copy.weight == scene::Color{1, 1, 1});
    const auto& uv = product.uv[copy.first_vertex];
    const auto x = static_cast<std::size_t>(uv[0] * static_cast<float>(product.atlas.width)),
               y = static_cast<std::size_t>(uv[1] * static_cast<float>(product.atlas.height));
    CHECK(product.atlas.rgba[4 * (y * static_cast<std::size_t>(product.atlas.width) + x) + 1] == image::encode_srgb8(expected));
    ++dimmed;
  }
  CHECK(dimmed >= 4);
}
