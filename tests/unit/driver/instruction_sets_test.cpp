#include "tests/support/instruction_sets.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "compiler/driver/compile.h"
#include "compiler/driver/trace_film.h"

using namespace orbc;

namespace {

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

constexpr const char* kRoom = R"(
room: {height: 0.9, floor: {checker: [ivory, slategray], cell: 0.25}, walls: {all: {mirror: {reflectance: 0.9}}, 1: {mirror: none}}}
objects:
  - {torus_knot: {p: 2, q: 3, radius: 0.09, tube: 0.03}, at: {polar: [0.2, 200deg], z: 0.15}, material: coral}
  - {sphere: {radius: 0.07}, at: {polar: [0.2, 100deg]}, material: gold}
lights: [{kind: sphere, at: {polar: [0.05, 40deg], z: 0.7}, radius: 0.05, power: 4, temperature: 3400}]
camera: {at: {polar: [0.15, 40deg], z: 0.45}, look_at: {polar: [0.2, 200deg], z: 0.15}, fov: 80deg, size: [24, 18]}
cover: {max_bounces: 2}
)";

driver::LoadedScene open(const std::string& notation) {
  const auto path = std::filesystem::path(ORBC_BINARY_DIR) / "instruction_sets_test.yaml";
  std::ofstream(path) << "orbc: 1\norbifold: \"" << notation << "\"" << kRoom;
  return std::move(driver::load(path.string(), {{"<test>", "bake.quality=draft"}})).value();
}

/// All that an exporter gets and all that the tracer draws, as bytes; what surfaces pass on to each other in the picture alone.
std::string everything(const std::string& notation) {
  driver::LoadedScene loaded = open(notation);
  const auto compiled = driver::compile(loaded, {}, serial_executor());
  const driver::Product& product = compiled.value().product;
  std::string bytes;
  append(bytes, product.positions);
  append(bytes, product.uv);
  append(bytes, product.indices);
  append(bytes, product.atlas.rgba);
  loaded = open(notation);
  loaded.scene.integrator = scene::Integrator::path;
  const render::Film film = driver::trace_film(loaded, {2}, serial_executor());
  append(bytes, film.color);
  append(bytes, film.depth);
  append(bytes, film.normal);
  append(bytes, film.object);
  append(bytes, film.error);
  return bytes;
}

}  // namespace

TEST_CASE("exports and pictures have the same bytes with every instruction set", "[driver][long]") {
  const std::string notation = GENERATE("*222", "*333", "*22222");
  const auto made = orbc::testing::with_each_instruction_set([&] { return everything(notation); });
  REQUIRE(made.size() >= 2);
  REQUIRE(made[0].size() > 10000);
  for (std::size_t i = 1; i < made.size(); ++i) {
    INFO(notation << ", " << orbc::testing::name_of(orbc::testing::instruction_sets()[i]));
    CHECK(made[i] == made[0]);
  }
}
