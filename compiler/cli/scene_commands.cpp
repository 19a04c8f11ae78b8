#include <fmt/format.h>

#include <algorithm>

#include "compiler/animation/moment.h"
#include "compiler/cli/commands.h"
#include "compiler/cli/effects.h"
#include "compiler/cli/expanded_star.h"
#include "compiler/cli/result.h"
#include "compiler/cli/scene_report.h"
#include "compiler/cli/streams.h"
#include "compiler/cli/support.h"
#include "compiler/notation/euler.h"
#include "compiler/notation/parse.h"
#include "compiler/notation/print.h"
#include "compiler/room/realise.h"
#include "compiler/room/view.h"
#include "compiler/scene/animation.h"
#include "compiler/scene/starter.h"

namespace orbc::cli {

int new_scene(const NewArguments& a, const Common& common) {
  notation::ParseOptions options;
  options.span = {std::make_shared<SourceText>(SourceText{"notation", a.notation}), 1, 1, a.notation.size()};
  options.allow_non_orbifold = true;
  const auto parsed = notation::parse_with_notes(a.notation, options);
  if (!parsed) return print(with_star_hint(parsed.error(), a.notation), common), kSceneWrong;
  Diagnostics notes = parsed->notes;
  if (!notation::is_orbifold(parsed->orbifold))
    notes.push_back(make_warning(
        "notation.non-orbifold-room",
        "a corner that is no integer: the mirror images of this room overlap, each is seen through its chain of mirrors alone",
        "the scene says `allow_non_orbifold: true`; corners with integers make an orbifold", options.span));
  if (!common.quiet) print_message(to_text(notes));
  const auto room = room::realise(parsed->orbifold, {}, true);
  if (!room) return print(located(room.error(), options.span), common), kSceneWrong;
  const std::string notation = notation::to_text(parsed->orbifold);
  const std::string scene =
      schema_line() +
      scene::starter_scene({notation, static_cast<int>(room->walls.size()), room->inradius, room::view_direction(*room)});
  if (!common.json) write_standard_output(scene);
  print_result({{"orbifold", notation}, {"scene", scene}}, notes, common);
  return kDone;
}

namespace {

/// What is wrong with a film at four moments of it.
Diagnostics wrong_moments(const std::string& path, const scene::Overrides& overrides, const scene::Animation& animation,
                          std::uint64_t max_memory) {
  if (path == "-") return {};  // standard input is read once
  const auto text = driver::open(path);
  if (!text) return text.error();
  const auto with = [&](const scene::Overrides& more) {
    scene::Overrides all = overrides;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  for (const double t : {0.0, 0.25, 0.5, 0.75}) {
    const auto moment = animation::overrides_at(
        animation, t, [&](const scene::Overrides& more) { return scene::read_scene(text->source, text->folder, with(more)); });
    if (!moment) return moment.error();
    const auto loaded = driver::load(*text, with(*moment), max_memory);
    if (!loaded) return loaded.error();
  }
  return {};
}

}  // namespace

int check(const CheckArguments& a, const Common& common) {
  if (std::count(a.scenes.begin(), a.scenes.end(), "-") > 1) throw UsageError("standard input can be read once: give - once");
  int code = kDone;
  Diagnostics all;
  nlohmann::ordered_json reports = nlohmann::ordered_json::array();
  scene::Overrides overrides;
  append_set(a.set, overrides);
  for (const std::string& path : a.scenes) {
    auto loaded = driver::load(path, overrides, parse_bytes(common.max_memory));
    if (loaded) append(loaded->notes, without_effect(common.given, {kTraced | kPov | kGltf, false, false, false, 1}, *loaded));
    const bool moves = loaded && loaded->scene.animation;
    const Diagnostics wrong =
        moves ? wrong_moments(path, overrides, *loaded->scene.animation, parse_bytes(common.max_memory)) : Diagnostics{};
    Diagnostics found = loaded ? loaded->notes : loaded.error();
    append(found, wrong);
    Common plain = common;
    plain.json = false;
    if (!common.json) print(found, plain);
    all.insert(all.end(), found.begin(), found.end());
    const bool is_right = loaded && !has_error(wrong);
    if (!is_right) code = kSceneWrong;
    if (is_right && common.verbose) reports.push_back(scene_report(path, *loaded));
    if (is_right && !common.quiet && !common.json) {
      print_message(fmt::format("{}: {} is all right ({} walls, {} objects, {} lights)\n", path == "-" ? "standard input" : path,
                 notation::to_text(loaded->scene.orbifold), loaded->interior->polygon.walls.size(), loaded->scene.objects.size(),
                 loaded->scene.lamps.size()));
      if (common.verbose) print_message(report_text(reports.back()));
    }
  }
  if (common.json)
    write_standard_output(fmt::format("{{\"ok\": {}, {}\"diagnostics\": {}}}\n", code == kDone,
                                      common.verbose ? "\"scenes\": " + reports.dump() + ", " : "", to_json(all)));
  return code;
}

}  // namespace orbc::cli
