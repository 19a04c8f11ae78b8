#include "compiler/driver/open.h"

#include <iostream>
#include <iterator>

#include "compiler/light/lamp.h"
#include "compiler/light/lighting.h"
#include "compiler/mesh_io/load.h"
#include "compiler/place/furnish.h"
#include "compiler/room/realise.h"
#include "compiler/scene/read.h"

namespace orbc::driver {
namespace {

constexpr std::size_t kLargestInput = 8 << 20;  // read_scene refuses less; this only keeps an endless pipe out of the memory

Result<scene::ReadResult> read(const std::string& path, const scene::Overrides& overrides) {
  if (path != "-") return scene::load_scene(path, overrides);
  auto source = std::make_shared<SourceText>();
  source->name = "<stdin>";
  for (std::istreambuf_iterator<char> at(std::cin), end; at != end && source->text.size() < kLargestInput; ++at) source->text += *at;
  return scene::read_scene(std::shared_ptr<const SourceText>(source), ".", overrides);
}

void append(Diagnostics& to, const Diagnostics& from) { to.insert(to.end(), from.begin(), from.end()); }

}  // namespace

Result<Opened> open_scene(const std::string& path, const scene::Overrides& overrides) {
  auto read_in = read(path, overrides);
  if (!read_in) return read_in.error();
  Opened opened;
  opened.scene = std::move(read_in->scene), opened.notes = std::move(read_in->notes);
  opened.expected_background = opened.scene.cover.background_expected;
  const auto room = room::realise(opened.scene.orbifold, opened.scene.room.shape, opened.scene.allow_non_orbifold);
  if (!room) return located(room.error(), opened.scene.room.shape.span.source ? opened.scene.room.shape.span : opened.scene.span);
  auto furnished = place::furnish(opened.scene, *room, mesh_io::assets_from_files());
  if (!furnished) return located(furnished.error(), opened.scene.span);
  append(opened.notes, located(furnished->warnings, opened.scene.span));
  const auto lamps = light::place_lamps(opened.scene, *room);
  if (!lamps) return located(lamps.error(), opened.scene.span);
  append(opened.notes, located(lamps.value().warnings, opened.scene.span));
  if (auto inside = light::lamps_inside_objects(opened.scene, *lamps, furnished->interior); !inside.empty()) return inside;
  const light::LightOptions light = light::light_options(opened.scene);
  if (const auto images = light::lamp_images(lamps->lamps, furnished->interior, {light.bounces, opened.scene.exposure, light.cull_below});
      !images)
    return located(located(images.error(), opened.scene.bake.mirror_bounces_span), opened.scene.span);
  light::add_lamp_bodies(opened.scene, *lamps, furnished->interior);
  opened.room = std::make_unique<place::Interior>(std::move(furnished->interior));
  const auto eye = place::make_camera(opened.scene, *opened.room);
  if (!eye) return located(eye.error(), opened.scene.camera.span.source ? opened.scene.camera.span : opened.scene.span);
  opened.eye = *eye;
  return opened;
}

}  // namespace orbc::driver
