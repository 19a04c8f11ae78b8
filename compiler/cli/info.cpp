#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "compiler/cli/commands.h"
#include "compiler/cli/expanded_star.h"
#include "compiler/cli/isometries_json.h"
#include "compiler/cli/streams.h"
#include "compiler/cli/support.h"
#include "compiler/notation/classify.h"
#include "compiler/notation/euler.h"
#include "compiler/notation/growth.h"
#include "compiler/notation/parse.h"
#include "compiler/notation/print.h"
#include "compiler/room/realise.h"
#include "compiler/room/summary.h"

namespace orbc::cli {
namespace {

constexpr std::size_t kShownCounts = 20;  // of the counts per length in the text for people

struct Facts {
  notation::Orbifold orbifold;
  geometry::Space space{};
  bool tiles = true;                ///< integer corners: there is a group
  std::vector<Integer> copies;
  room::Room room;
};

/// Names the setting as this command takes it: there is no scene here.
Diagnostics with_flag_hint(Diagnostics errors) {
  for (Diagnostic& error : errors)
    if (error.code == "notation.non-orbifold-corner") error.hint = "rooms that are no orbifolds need --allow-non-orbifold";
  return errors;
}

Result<Facts> facts_of(const InfoArguments& a, Diagnostics& notes) {
  notation::ParseOptions options;
  options.allow_non_orbifold = a.allow_non_orbifold;
  options.span = {std::make_shared<SourceText>(SourceText{"notation", a.notation}), 1, 1, a.notation.size()};
  auto parsed = notation::parse_with_notes(a.notation, options);
  if (!parsed) return with_star_hint(with_flag_hint(parsed.error()), a.notation);
  notes = parsed->notes;
  Facts facts;
  facts.orbifold = parsed->orbifold;
  auto space = notation::classify(facts.orbifold, options.span);
  if (!space) return space.error();
  facts.space = *space;
  facts.tiles = notation::is_orbifold(facts.orbifold);
  if (facts.tiles) facts.copies = notation::copies_per_length(facts.orbifold, a.max_length);
  scene::Shape shape;
  shape.kind = a.shape == "paper" ? scene::ShapeKind::paper : scene::ShapeKind::tangential;
  shape.cut = a.cut;
  auto room = room::realise(facts.orbifold, shape, a.allow_non_orbifold);
  if (!room) return located(room.error(), options.span);
  facts.room = *room;
  return facts;
}

std::string json_text(const Facts& f, int copies) {
  using Json = nlohmann::ordered_json;
  const auto number = [](double v) { return Json(v).dump(); };
  std::vector<std::string> lines;
  const auto add = [&](const char* key, const std::string& raw) { lines.push_back(fmt::format("  \"{}\": {}", key, raw)); };
  const auto list = [&](const auto& values, auto&& text) {
    std::vector<std::string> parts;
    for (const auto& value : values) parts.push_back(text(value));
    return fmt::format("[{}]", fmt::join(parts, ", "));
  };
  add("notation", Json(notation::to_text(f.orbifold)).dump());
  add("canonical", Json(notation::to_text(notation::canonical(f.orbifold))).dump());
  add("space", Json(geometry::name(f.space)).dump());
  add("chi", Json(to_string(notation::euler_characteristic(f.orbifold))).dump());
  add("area", number(f.room.area));
  const auto order = f.tiles ? notation::group_order(f.orbifold) : std::nullopt;
  const auto rate = f.tiles ? notation::growth_rate(f.orbifold) : std::nullopt;
  add("group_order", order ? to_string(*order) : "null");
  add("growth_rate", rate ? number(*rate) : "null");
  add("copies_per_length", f.tiles ? list(f.copies, [](const Integer& n) { return to_string(n); }) : "null");
  add("sides", list(f.room.walls, [&](const room::Wall& w) { return number(w.length); }));
  add("angles", list(f.room.corners, [&](const room::Corner& c) { return number(c.angle); }));
  add("inradius", f.room.inradius > 0 ? number(f.room.inradius) : "null");
  add("circumradius", number(f.room.circumradius));
  add("moduli", std::to_string(room::summarise(f.room).moduli));
  const int cover = room::summarise(f.room).translational_cover;
  add("translational_cover", cover ? std::to_string(cover) : "null");
  add("corners", list(f.room.corners, [&](const room::Corner& c) { return corner_json(f.room.space, c.at); }));
  if (f.tiles) add("copies", list(first_copies(f.room, copies), copy_json));
  add("certificate", fmt::format("{{\"convex\": {}, \"angle_residual\": {}, \"closure_residual\": {}, \"area_residual\": {}}}",
                                 f.room.certificate.convex, number(f.room.certificate.angle_residual),
                                 number(f.room.certificate.closure_residual), number(f.room.certificate.area_residual)));
  return fmt::format("{{\n{}\n}}\n", fmt::join(lines, ",\n"));
}

std::string space_sentence(const Facts& f) {
  switch (f.space) {
    case geometry::Space::spherical: return "spherical: the room lies on the unit sphere, finitely many copies cover it";
    case geometry::Space::euclidean: return "Euclidean: copies of the room tile the plane";
    case geometry::Space::hyperbolic: return "hyperbolic: copies of the room tile the hyperbolic plane";
  }
  return {};
}

std::string people_text(const Facts& f) {
  std::string text;
  const auto line = [&](const char* what, const std::string& value) { text += fmt::format("{:<18}{}\n", what, value); };
  line("orbifold", notation::to_text(f.orbifold));
  line("canonical form", notation::to_text(notation::canonical(f.orbifold)));
  line("space", f.tiles ? space_sentence(f) : fmt::format("{}; no orbifold: its copies do not fit together", geometry::name(f.space)));
  const Rational chi = notation::euler_characteristic(f.orbifold);
  line("chi", to_string(chi));
  line("area",
       f.space == geometry::Space::euclidean ? fmt::format("{:.12g}", f.room.area) : fmt::format("{:.12g}  (= 2 pi |chi|)", f.room.area));
  if (f.tiles) {
    if (const auto order = notation::group_order(f.orbifold)) line("group", fmt::format("{} copies in all", to_string(*order)));
    else if (const auto rate = notation::growth_rate(f.orbifold))
      line("growth rate", f.space == geometry::Space::euclidean ? "1 (polynomial)" : fmt::format("{:.12g}", *rate));
    std::vector<std::string> counts;
    for (std::size_t i = 0; i < f.copies.size() && i < kShownCounts; ++i) counts.push_back(to_string(f.copies[i]));
    line("copies by bounces", fmt::format("{}{}", fmt::join(counts, " "), f.copies.size() > kShownCounts ? " ..." : ""));
  }
  if (const int cover = room::summarise(f.room).translational_cover)
    line("translations", fmt::format("{} copies make the translational cover", cover));
  line("inradius", f.room.inradius > 0 ? fmt::format("{:.12g}", f.room.inradius) : "none: no circle touches all walls");
  line("free lengths", std::to_string(room::summarise(f.room).moduli));
  if (f.room.corners.empty()) line("wall 1", fmt::format("length {:.12g}, no corner", f.room.walls.front().length));
  for (std::size_t i = 0; i < f.room.corners.size(); ++i)
    line(fmt::format("corner {}", i + 1).c_str(),
         fmt::format("{:>9.5f} deg    wall {} has length {:.12g}{}", f.room.corners[i].angle * 180 / 3.14159265358979323846, i + 1,
                     f.room.walls[i].length, f.room.walls[i].reflects ? "" : " (plain end wall)"));
  return text;
}

}  // namespace

int info(const InfoArguments& a, const Common& common) {
  Diagnostics notes;
  const auto facts = facts_of(a, notes);
  if (!facts) return print(facts.error(), common), kSceneWrong;
  if (!common.quiet) for (const Diagnostic& note : notes) print_message(to_text(note));
  write_standard_output(common.json ? json_text(*facts, a.copies) : people_text(*facts));
  return kDone;
}

}  // namespace orbc::cli
