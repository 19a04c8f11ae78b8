// The renderer's own lamps: every copy has the images that light reaches it from, where they are, as bright as they are.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "compiler/driver/compile.h"

using namespace orbc;

namespace {

driver::LoadedScene flat_room(const std::string& more) {
  const auto path = std::filesystem::temp_directory_path() / ("orbc-native-" + std::to_string(getpid()) + ".yaml");
  std::ofstream(path)
      << "orbc: 1\norbifold: \"*2222\"\nroom: {height: 0.9, walls: {all: {mirror: {reflectance: 0.8, tint: white}}}}\nobjects:\n"
         "  - {box: {size: [0.2, 0.2, 0.2]}, at: {polar: [0.3, 100deg]}, material: tomato}\n"
         "lights:\n  - {kind: sphere, at: {polar: [0.2, 200deg], z: 0.6}, radius: 0.05, power: 8}\n"
         "exposure: 0.5\nambient: white\n"
         "camera: {at: {polar: [0.3, 230deg], z: 0.45}, size: [40, 30]}\n" +
             more;
  auto done = driver::load(path.string());
  std::filesystem::remove(path);
  REQUIRE(done);
  return std::move(done).value();
}

double apart(const geometry::Vector3& a, const geometry::Vector3& b) { return geometry::length(a - b); }

}  // namespace

TEST_CASE("every copy is lit by its own lamp and by its images in the mirrors, each with its weight", "[driver]") {
  const driver::LoadedScene scene = flat_room("bake: {lights: native, mirrors: 1}\ncover: {max_bounces: 1}\n");
  const auto compiled = driver::compile(scene, {}, serial_executor());
  REQUIRE(compiled);
  CHECK(compiled->notes.empty());
  const driver::Product& product = compiled->product;
  REQUIRE(product.native);
  CHECK(compiled->report.copies == 5);
  REQUIRE(product.copies.size() == 10);  // the body of the lamp is drawn by itself
  CHECK(product.native->lamps.size() == 5 * 5);
  CHECK(product.native->ambient.r == Approx(0.5));
  const double pi = std::numbers::pi;
  std::vector<geometry::Vector3> own(10), mirrored;
  for (const native_lights::NativeLamp& lamp : product.native->lamps) {
    const driver::ProductCopy& copy = product.copies[lamp.copy];
    CHECK(copy.shading == native_lights::Shading::lit);
    CHECK(lamp.intensity.g == Approx(0.5 * 8 / (4 * pi * pi) * std::pow(0.8, copy.bounces + (lamp.direct ? 0 : 1))));
    CHECK(geometry::length(lamp.half_u) == Approx(0.05));
    if (lamp.direct) own[lamp.copy] = lamp.at;
    else if (lamp.copy == 0) mirrored.push_back(lamp.at);
  }
  for (std::size_t i = 1; i < 5; ++i)  // what hangs behind a mirror is its image
    CHECK(std::any_of(mirrored.begin(), mirrored.end(), [&](const geometry::Vector3& at) { return apart(at, own[i]) < 1e-9; }));
  for (std::size_t i = 5; i < 10; ++i) CHECK(product.copies[i].shading == native_lights::Shading::lamp_body);
  REQUIRE(product.normals.size() == product.positions.size());
  for (const auto& n : product.normals) CHECK(std::hypot(std::hypot(n[0], n[1]), n[2]) == Approx(1).margin(1e-5));
}

TEST_CASE("normals are apart at the edges of a box and alike on its faces", "[driver]") {
  const driver::LoadedScene scene = flat_room("bake: {lights: native, mirrors: 0}\ncover: {max_bounces: 0}\n");
  const driver::Product product = driver::compile(scene, {}, serial_executor())->product;
  for (std::size_t i = 0; i < product.copies[0].index_count; i += 3) {
    geometry::Vector3 p[3], n[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& at = product.positions[product.indices[i + k]];
      const auto& normal = product.normals[product.indices[i + k]];
      p[k] = {at[0], at[1], at[2]}, n[k] = {normal[0], normal[1], normal[2]};
    }
    const geometry::Vector3 flat = geometry::normalised(geometry::cross(p[1] - p[0], p[2] - p[0]));
    for (const auto& own : n) CHECK(apart(own, flat) < 1e-4);  // there are only flat things in the room
  }
}

TEST_CASE("a scene without lamps has none to hang, and --view disk cannot have them", "[driver]") {
  driver::LoadedScene scene = flat_room("bake: {lights: native}\ncover: {max_bounces: 0}\n");
  driver::CompileOptions disk;
  disk.bend.view = bend::View::disk;
  const auto refused = driver::compile(scene, disk, serial_executor());
  REQUIRE(!refused);
  CHECK(refused.error()[0].code == "driver.native-view");
  scene.scene.lamps.clear();
  const auto plain = driver::compile(scene, {}, serial_executor());
  REQUIRE(plain);
  CHECK(!plain->product.native);
  CHECK(plain->product.normals.empty());
}
