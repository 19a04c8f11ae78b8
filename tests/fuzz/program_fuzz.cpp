// libFuzzer: any scene, with any bytes as the meshes it names, becomes a picture and exports, or diagnostics. The input is the text of a
// scene, and behind a line "%mesh" the bytes of every mesh. Run in one process, with bounds that end each input soon:
//   bin/program -dict=tests/fuzz/scene.dict -max_len=8192 -timeout=10 -rss_limit_mb=2048 corpus
// Light is traced, not baked: a bake takes a second, and its texels are tested elsewhere.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "compiler/driver/compile.h"
#include "compiler/driver/load.h"
#include "compiler/driver/trace_film.h"
#include "compiler/mesh_io/load.h"
#include "exporters/gltf/write_gltf.h"
#include "exporters/pov/write_pov.h"

namespace {

using namespace orbc;

constexpr std::string_view kSeparator = "\n%mesh\n";
constexpr int kWidth = 8, kHeight = 6, kMaxBounces = 2, kMaxWalls = 8;
constexpr std::uint64_t kMaxTriangles = 2000, kMaxMemory = 64 << 20;

mesh::AssetSource assets_of(std::string_view bytes) {
  mesh_io::LoadOptions options = mesh_io::bounds_within(kMaxMemory);
  options.max_triangles = kMaxTriangles;
  options.images.max_bytes = 1 << 20;
  const auto format_of = [](const std::string& path) {
    constexpr std::pair<const char*, mesh_io::Format> kEndings[] = {{"ply", mesh_io::Format::ply},
                                                                    {"off", mesh_io::Format::off},
                                                                    {"stl", mesh_io::Format::stl},
                                                                    {"glb", mesh_io::Format::glb},
                                                                    {"gltf", mesh_io::Format::gltf}};
    for (const auto& [ending, format] : kEndings)
      if (path.size() > 4 && path.find(ending, path.size() - 4) != path.npos) return format;
    return mesh_io::Format::obj;
  };
  mesh::AssetSource assets = mesh::no_assets();
  assets.load_mesh = [=](const std::string& path) { return mesh_io::load_mesh_bytes(bytes, format_of(path), path, "", options); };
  return assets;
}

/// Makes the scene small; false when it cannot be.
bool make_small(scene::Scene& scene) {
  scene.camera.size = {kWidth, kHeight};
  scene.cover.max_bounces = std::min(scene.cover.max_bounces, kMaxBounces);
  scene.bake.mirror_bounces = std::min(scene.bake.mirror_bounces, 1);
  scene.bake.quality = scene::BakeQuality::draft;
  scene.bake.samples = 32;
  return scene.room.walls.size() <= kMaxWalls && scene.objects.size() <= 4 && scene.lamps.size() <= 2;
}

void check(bool holds) {
  if (!holds) std::abort();
}

void compile(const driver::PreparedScene& prepared) {
  driver::CompileOptions options;
  options.bend.max_triangles = 20 * kMaxTriangles;
  options.max_memory = kMaxMemory;
  const auto compiled = driver::compile(prepared, prepared.loaded().eye, options, serial_executor());
  if (!compiled) return check(has_error(compiled.error()));
  const driver::Product& product = compiled->product;
  for (const std::uint32_t i : product.indices) check(i < product.positions.size());
  for (const auto& p : product.positions) check(std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]));
  check(!pov::write_pov(product, {"fuzz"}).empty());
  check(!gltf::write_gltf(product).empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const std::size_t end = input.find(kSeparator);
  const std::string_view mesh = end == input.npos ? std::string_view{} : input.substr(end + kSeparator.size());
  auto read = scene::read_scene(std::make_shared<const SourceText>(SourceText{"fuzz.yaml", std::string(input.substr(0, end))}));
  if (!read) return check(has_error(read.error())), 0;
  if (!make_small(read->scene)) return 0;
  auto loaded = driver::load(*std::move(read), assets_of(mesh));
  if (!loaded) return check(has_error(loaded.error())), 0;
  const driver::PreparedScene prepared(*std::move(loaded));
  const render::Film film = driver::trace_film(prepared, prepared.loaded().eye, {}, serial_executor());
  for (const scene::Color& color : film.color) check(std::isfinite(color.r) && std::isfinite(color.g) && std::isfinite(color.b));
  if (!prepared.drawn_scene().is_baked()) compile(prepared);
  return 0;
}
