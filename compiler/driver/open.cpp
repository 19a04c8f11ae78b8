#include "compiler/driver/open.h"

#include <iostream>
#include <iterator>

#include "compiler/light/lamp.h"
#include "compiler/place/furnish.h"
#include "compiler/room/realise.h"
#include "compiler/scene/read.h"

namespace orbc::driver {
namespace {

constexpr std::size_t kLargestInput = 8 << 20;  // read_scene refuses less; this only keeps an endless pipe out of the memory

Result<scene::Read> read(const std::string& path) {
  if (path != "-") return scene::load_scene(path);
  auto source = std::make_shared<SourceText>();
  source->name = "<stdin>";
  for (std::istreambuf_iterator<char> at(std::cin), end; at != end && source->text.size() < kLargestInput; ++at) source->text += *at;
  return scene::read_scene(std::shared_ptr<const SourceText>(source), ".");
}

void apply(const Overrides& overrides, scene::Scene& scene) {
  if (overrides.size) scene.camera.size = *overrides.size;
  if (overrides.max_bounces) scene.cover.max_bounces = *overrides.max_bounces;
  if (overrides.projection) scene.camera.projection = *overrides.projection;
  if (overrides.integrator) scene.integrator = *overrides.integrator;
  if (overrides.quality) scene.bake.quality = *overrides.quality;
}

void append(Diagnostics& to, const Diagnostics& from) { to.insert(to.end(), from.begin(), from.end()); }

}  // namespace

Result<Opened> open_scene(const std::string& path, const Overrides& overrides) {
  auto read_in = read(path);
  if (!read_in) return read_in.error();
  Opened opened{std::move(read_in->scene), nullptr, {}, std::move(read_in->notes)};
  apply(overrides, opened.scene);
  opened.expected_background = overrides.expected_background || opened.scene.cover.background_expected;
  const auto room = room::realise(opened.scene.orbifold, opened.scene.room.shape, opened.scene.allow_non_orbifold);
  if (!room) return located(room.error(), opened.scene.room.shape.span.source ? opened.scene.room.shape.span : opened.scene.span);
  auto furnished = place::furnish(opened.scene, *room);
  if (!furnished) return located(furnished.error(), opened.scene.span);
  append(opened.notes, located(furnished->warnings, opened.scene.span));
  const auto lamps = light::hang_lamps(opened.scene, *room);
  if (!lamps) return located(lamps.error(), opened.scene.span);
  append(opened.notes, located(lamps.value().warnings, opened.scene.span));
  if (auto inside = light::lamps_inside_objects(opened.scene, *lamps, furnished->room); !inside.empty()) return inside;
  light::add_fixtures(opened.scene, *lamps, furnished->room);
  opened.room = std::make_unique<place::PlacedRoom>(std::move(furnished->room));
  const auto eye = place::make_eye(opened.scene, *opened.room);
  if (!eye) return located(eye.error(), opened.scene.camera.span.source ? opened.scene.camera.span : opened.scene.span);
  opened.eye = *eye;
  return opened;
}

}  // namespace orbc::driver
