#include "compiler/driver/load.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "compiler/driver/straight.h"
#include "compiler/driver/unit_of_length.h"
#include "compiler/light/lighting.h"
#include "compiler/mesh_io/load.h"
#include "compiler/place/furnish.h"
#include "compiler/room/realise.h"

namespace orbc::driver {
namespace {

constexpr std::string_view kStandardInput = "<stdin>";
constexpr std::size_t kMaxInputBytes = 8 << 20;  // keeps an endless pipe out of the memory; read_scene refuses less

void append(Diagnostics& to, const Diagnostics& from) { to.insert(to.end(), from.begin(), from.end()); }

/// room → furnish → place lamps → eye.
Result<LoadedScene> furnish_and_light(scene::Scene scene, const mesh::AssetSource& assets) {
  const auto room = room::realise(scene.orbifold, scene.room.shape, scene.allow_non_orbifold);
  if (!room) return located(room.error(), scene.room.shape.span.source ? scene.room.shape.span : scene.span);
  auto furnished = place::furnish(scene, *room, assets);
  if (!furnished) return located(furnished.error(), scene.span);
  LoadedScene loaded;
  loaded.notes = located(std::move(furnished->warnings), scene.span);
  auto lamps = light::prepare_lamps(scene, furnished->interior, light::light_options(scene));
  if (!lamps) return located(lamps.error(), scene.span);
  append(loaded.notes, located(lamps->warnings, scene.span));
  loaded.interior = std::make_shared<const place::Interior>(light::with_lamp_bodies(scene, lamps->lamps, std::move(furnished->interior)));
  loaded.lamps = std::make_shared<const light::LampSet>(std::move(*lamps));
  const auto eye = place::make_camera(scene, *loaded.interior);
  if (!eye) return located(eye.error(), scene.camera.span.source ? scene.camera.span : scene.span);
  loaded.eye = *eye;
  if (draws_straight(scene)) loaded.eye.lens.reset();
  loaded.scene = std::move(scene);
  return loaded;
}

}  // namespace

// Like the command line this reads standard input: a scene may come through a pipe.
Result<scene::SceneText> open(const std::string& path) {
  if (path != "-") return scene::open_scene(path);
  auto source = std::make_shared<SourceText>();
  source->name = kStandardInput;
  std::array<char, 1 << 16> buffer{};
  while (source->text.size() < kMaxInputBytes) {
    const ssize_t got = ::read(STDIN_FILENO, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      return make_error("scene.cannot-read", fmt::format("cannot read the scene from standard input: {}", std::strerror(errno)),
                        "pipe a scene in, or give the path of a scene file");
    if (got == 0) break;
    source->text.append(buffer.data(), static_cast<std::size_t>(got));
  }
  return scene::SceneText{std::shared_ptr<const SourceText>(source), "."};
}

Result<LoadedScene> load(const std::string& path, const scene::Overrides& overrides, std::uint64_t max_memory) {
  const auto text = open(path);
  if (!text) return text.error();
  return load(*text, overrides, max_memory);
}

Result<LoadedScene> load(const scene::SceneText& text, const scene::Overrides& overrides, std::uint64_t max_memory) {
  auto read = scene::read_scene(text.source, text.folder, overrides);
  if (!read) return read.error();
  std::vector<std::string> files{text.source->name == kStandardInput ? "-" : text.source->name};
  mesh_io::LoadOptions options = mesh_io::bounds_within(max_memory);
  options.on_read = [&files](const std::string& file) {
    if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
  };
  auto loaded = load(*std::move(read), mesh_io::assets_from_files(options));
  if (loaded) loaded->files = std::move(files);
  return loaded;
}

Result<LoadedScene> load(scene::ReadResult read, const mesh::AssetSource& assets) {
  const double unit = unit_of_length(read.scene);
  auto loaded = furnish_and_light(in_compiled_unit(read.scene, unit), assets);
  if (unit != 1 && (!loaded || !loaded->notes.empty())) {
    // Messages name lengths in the author's unit.
    const auto in_author_unit = furnish_and_light(read.scene, assets);
    if (!loaded) return in_author_unit ? loaded.error() : in_author_unit.error();
    if (in_author_unit) loaded->notes = in_author_unit->notes;
  }
  if (!loaded) return loaded;
  loaded->unit_of_length = unit;
  append(read.notes, loaded->notes);
  loaded->notes = std::move(read.notes);
  return loaded;
}

Result<place::Camera> eye_of(const scene::Scene& scene, const LoadedScene& loaded) {
  auto eye = place::make_camera(in_compiled_unit(scene, loaded.unit_of_length), *loaded.interior);
  if (eye && draws_straight(scene)) eye->lens.reset();
  return eye;
}

}  // namespace orbc::driver
