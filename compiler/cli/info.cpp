#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

#include "compiler/cli/commands.h"
#include "compiler/cli/expanded_star.h"
#include "compiler/cli/isometries_json.h"
#include "compiler/cli/streams.h"
#include "compiler/cli/support.h"
#include "compiler/cli/symbol_info.h"
#include "compiler/notation/classify.h"
#include "compiler/notation/euler.h"
#include "compiler/notation/growth.h"
#include "compiler/notation/parse.h"
#include "compiler/notation/print.h"
#include "compiler/notation/symbol.h"
#include "compiler/notation/translate.h"
#include "compiler/room/glued_polygon.h"
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

/// The sides of a room closed by mirrors, in the words of symbol_json.
template <typename Add, typename List>
void add_sides(const Facts& f, const Add& add, const List& list) {
  const std::size_t walls = f.room.walls.size();
  std::vector<std::size_t> numbers(walls);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  add("sides",
      list(numbers, [&](std::size_t i) { return fmt::format("[\"m{}\", \"{}\"]", i, f.room.walls[i].reflects ? "mirror" : "wall"); }));
  add("partner", list(numbers, [](std::size_t i) { return std::to_string(i); }));
  add("side_lengths", list(f.room.walls, [&](const room::Wall& w) { return nlohmann::ordered_json(w.length).dump(); }));
  if (f.tiles && f.orbifold.corners.size() >= 3) {
    const auto order_at = [&](std::size_t i) { return static_cast<int>(numerator(f.orbifold.corners[i])); };
    add("corners_2pi_over", list(numbers, [&](std::size_t i) { return std::to_string(2 * order_at(i)); }));
    add("relators", list(numbers, [&](std::size_t i) {
          std::vector<std::size_t> word;
          for (int turn = 0; turn < order_at(i); ++turn) word.insert(word.end(), {i, (i + walls - 1) % walls});
          return fmt::format("[{}]", fmt::join(word, ", "));
        }));
  }
  if (f.tiles) add("letters", std::to_string(walls));
  if (f.tiles) add("counts", list(f.copies, [](const Integer& n) { return to_string(n); }));
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
  add("symbol", Json(notation::to_text(f.orbifold)).dump());
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
  if (f.orbifold.strip && f.orbifold.corners.empty()) {
    // As an orbifold `**` is the annulus: a piece of the strip whose ends are glued.
    lines.push_back(polygon_lines(*room::glued_polygon(notation::Symbol{0, {}, {{}, {}}, 0}), static_cast<int>(f.copies.size()) - 1));
  } else {
    add_sides(f, add, list);
  }
  if (order) add("order", to_string(*order));
  add("wall_lengths", list(f.room.walls, [&](const room::Wall& w) { return number(w.length); }));
  add("angles", list(f.room.corners, [&](const room::Corner& c) { return number(c.angle); }));
  if (!(f.orbifold.strip && f.orbifold.corners.empty())) add("inradius", f.room.inradius > 0 ? number(f.room.inradius) : "null");
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

namespace {

/// Tells of an orbifold that is not closed by mirrors alone. Nothing if the text is no such symbol, but for instance the name of a group.
std::optional<int> symbol_info(const InfoArguments& a, const Common& common) {
  const auto source = std::make_shared<SourceText>(SourceText{"notation", a.notation});
  const SourceSpan span{source, 1, 1, a.notation.size()};
  auto symbol = notation::parse_symbol(a.notation, span);
  const auto translation = symbol ? std::nullopt : notation::translate(a.notation);
  if (translation && !translation->conway.empty()) symbol = notation::parse_symbol(translation->conway);
  if (!symbol || notation::is_kaleidoscopic(*symbol) || notation::to_text(*symbol) == "1") return std::nullopt;
  const auto polygon = room::glued_polygon(*symbol);
  if (!polygon) return print(located(polygon.error(), span), common), kSceneWrong;
  if (translation && !common.quiet)
    print_message(
        to_text(make_note("notation.read-as", fmt::format("{} is read as {}", a.notation, notation::to_text(*symbol)), "", span)));
  write_standard_output(common.json ? symbol_json(*symbol, *polygon, a.max_length) : symbol_text(*symbol, *polygon));
  return kDone;
}

}  // namespace

int info(const InfoArguments& a, const Common& common) {
  Diagnostics notes;
  const auto facts = facts_of(a, notes);
  if (!facts) {
    if (const auto done = symbol_info(a, common)) return *done;
    return print(facts.error(), common), kSceneWrong;
  }
  if (!common.quiet) for (const Diagnostic& note : notes) print_message(to_text(note));
  write_standard_output(common.json ? json_text(*facts, a.copies) : people_text(*facts));
  return kDone;
}

}  // namespace orbc::cli
