#include "exporters/html/core/export.h"

#include <utility>

#include "compiler/driver/compile.h"
#include "compiler/driver/load.h"
#include "compiler/driver/prepare.h"
#include "compiler/driver/unlit.h"
#include "exporters/gltf/write_gltf.h"
#include "exporters/html/core/session.h"
#include "exporters/pov/write_pov.h"
#include "exporters/svg/write_svg.h"

namespace orbc::html {
namespace {

constexpr double kTolerancePx = 0.5;                          // of `orbc compile`
constexpr std::uint64_t kMaxMemory = std::uint64_t{3} << 29;  // bytes: WebAssembly has an address space of 4 GiB, browsers give 2

geometry::Isometry isometry_from(geometry::Space space, const double* m) {
  const geometry::Point at = geometry::normalised_point(space, {m[0], m[3], m[6]});
  const geometry::Isometry there = geometry::translation_to(space, at), back = geometry::inverse(there);
  const geometry::Tangent x = back * geometry::Tangent(m[1], m[4], m[7]), y = back * geometry::Tangent(m[2], m[5], m[8]);
  const geometry::Isometry turned = there * geometry::rotation(space, math::atan2(x.y, x.x));
  if (x.x * y.y - x.y * y.x > 0) return turned;
  return turned * geometry::reflection(space, {0, 0, 1});
}

/// Moves the eye of a scene, which has been loaded in a unit of its own if it is flat.
void move_eye(driver::LoadedScene& loaded, const double* eye) {
  const geometry::Space space = loaded.interior->polygon.space;
  std::array<double, 19> numbers;
  std::copy_n(eye, numbers.size(), numbers.begin());
  for (const std::size_t length : {3u, 6u, 9u})
    if (space == geometry::Space::euclidean || length == 9) numbers[length] *= loaded.unit_of_length;
  stand(loaded.eye, space, numbers.data());
}

driver::CompileOptions options() {
  driver::CompileOptions made;
  made.bend.tolerance_px = kTolerancePx / driver::kToleranceShares;
  made.bend.message_factor = driver::kToleranceShares;
  made.max_memory = kMaxMemory;
  return made;
}

Result<std::vector<driver::File>> draw_tiling(const driver::LoadedScene& loaded, ExportedScene& exported) {
  auto tiling = driver::tile(loaded, driver::Tiling::Model::disk, driver::Tiling::Coloring::parity);
  if (!tiling) return tiling.error();
  exported.copies = tiling->copies.size();
  return svg::write_svg(*tiling);
}

Result<std::vector<driver::File>> write_product(driver::LoadedScene loaded, bool pov, ExportedScene& exported, const Progress& progress) {
  if (loaded.scene.bake.atlas == scene::AtlasFormat::exr)
    return make_error("page.no-exr", "the page writes no EXR", "use `atlas: 16`, or the program orbc", loaded.scene.span);
  append(exported.diagnostics, driver::unlit_note(loaded));
  const driver::PreparedScene prepared(std::move(loaded));
  auto compiled = driver::compile(prepared, prepared.loaded().eye, options(), serial_executor(), progress);
  if (!compiled) return compiled.error();
  append(exported.diagnostics, compiled->notes);
  exported.copies = compiled->report.copies;
  exported.triangles = compiled->report.triangles;
  exported.error_px = compiled->report.error_bound_px;
  return pov ? pov::write_pov(compiled->product) : gltf::write_gltf(compiled->product);
}

}  // namespace

void stand(place::Camera& camera, geometry::Space space, const double* eye) {
  camera.room_from_eye = isometry_from(space, eye);
  camera.z = eye[9];
  camera.forward = {eye[10], eye[11], eye[12]};
  camera.right = {eye[13], eye[14], eye[15]};
  camera.up = {eye[16], eye[17], eye[18]};
}

ExportedScene export_scene(const std::shared_ptr<const SourceText>& source, const PageFiles& files, const WantedExport& wanted,
                           const Progress& progress) {
  ExportedScene exported;
  auto read = scene::read_scene(source);
  auto loaded = read ? driver::load(*std::move(read), assets_of_page(files)) : Result<driver::LoadedScene>(read.error());
  if (!loaded) return append(exported.diagnostics, loaded.error()), exported;
  append(exported.diagnostics, loaded->notes);
  if (wanted.eye) move_eye(*loaded, wanted.eye);
  auto made = wanted.format == "svg" ? draw_tiling(*loaded, exported)
                                     : write_product(*std::move(loaded), wanted.format == "pov", exported, progress);
  if (made) exported.files = *std::move(made);
  else append(exported.diagnostics, made.error());
  return exported;
}

}  // namespace orbc::html
