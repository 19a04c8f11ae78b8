#include "compiler/driver/load.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "compiler/light/lighting.h"
#include "compiler/mesh_io/load.h"
#include "compiler/place/furnish.h"
#include "compiler/room/realise.h"
#include "compiler/scene/read.h"

namespace orbc::driver {
namespace {

constexpr std::size_t kMaxInputBytes = 8 << 20;  // keeps an endless pipe out of the memory; read_scene refuses less

// Like the command line this reads standard input: a scene may come through a pipe.
Result<scene::ReadResult> read(const std::string& path, const scene::Overrides& overrides) {
  if (path != "-") return scene::load_scene(path, overrides);
  auto source = std::make_shared<SourceText>();
  source->name = "<stdin>";
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
  return scene::read_scene(std::shared_ptr<const SourceText>(source), ".", overrides);
}

void append(Diagnostics& to, const Diagnostics& from) { to.insert(to.end(), from.begin(), from.end()); }

}  // namespace

Result<LoadedScene> load(const std::string& path, const scene::Overrides& overrides) {
  auto read_in = read(path, overrides);
  if (!read_in) return read_in.error();
  LoadedScene loaded;
  loaded.scene = std::move(read_in->scene);
  loaded.notes = std::move(read_in->notes);
  const scene::Scene& scene = loaded.scene;
  const auto room = room::realise(scene.orbifold, scene.room.shape, scene.allow_non_orbifold);
  if (!room) return located(room.error(), scene.room.shape.span.source ? scene.room.shape.span : scene.span);
  loaded.files.push_back(path);
  mesh_io::LoadOptions options;
  options.on_read = [&files = loaded.files](const std::string& file) { files.push_back(file); };
  auto furnished = place::furnish(scene, *room, mesh_io::assets_from_files(options));
  if (!furnished) return located(furnished.error(), scene.span);
  append(loaded.notes, located(furnished->warnings, scene.span));
  auto lamps = light::prepare_lamps(scene, furnished->interior, light::light_options(scene));
  if (!lamps) return located(lamps.error(), scene.span);
  append(loaded.notes, located(lamps->warnings, scene.span));
  loaded.interior = std::make_shared<const place::Interior>(light::with_lamp_bodies(scene, lamps->lamps, std::move(furnished->interior)));
  loaded.lamps = std::make_shared<const light::LampSet>(std::move(*lamps));
  const auto eye = place::make_camera(scene, *loaded.interior);
  if (!eye) return located(eye.error(), scene.camera.span.source ? scene.camera.span : scene.span);
  loaded.eye = *eye;
  return loaded;
}

}  // namespace orbc::driver
