#include "compiler/driver/compile.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <set>

#include "compiler/cover/beam.h"
#include "compiler/cover/plan.h"
#include "compiler/cover/unfold.h"
#include "compiler/driver/estimate.h"
#include "compiler/driver/budget.h"
#include "compiler/driver/levels.h"
#include "compiler/driver/tail.h"
#include "compiler/geometry/chart.h"
#include "compiler/notation/print.h"

namespace orbc::driver {
namespace {

// The room's centre is the origin of its coordinates.
double distance_to(const cover::Copy& copy, const place::Eye& eye) {
  const geometry::Space space = eye.room_from_eye.space;
  return geometry::distance(space, copy.cover_from_room * geometry::Point(), eye.room_from_eye * geometry::Point());
}

std::vector<DrawnCopy> drawn(const std::vector<cover::Copy>& copies, const std::vector<bend::BentRange>& ranges, const place::Eye& eye) {
  std::vector<DrawnCopy> result;
  result.reserve(copies.size());
  for (std::size_t i = 0; i < copies.size(); ++i) {
    const cover::Copy& c = copies[i];
    const bend::BentRange& r = ranges[i];
    result.push_back({r.first_vertex, r.vertex_count, r.first_index, r.index_count, c.weight, c.word, c.bounces, c.sheet, c.cover_from_room.reversing, distance_to(c, eye),
                      c.storey.number, 0, c.wedge});
  }
  return result;
}

/// What the copies are drawn from.
std::vector<bend::Model> models_of(const light::Atlas& atlas, const Stock& stock, const Choice& choice) {
  std::vector<bend::Model> models;
  for (const auto& levels : choice.models) {
    models.emplace_back();
    for (std::size_t p = 0; p < levels.size(); ++p) {
      const std::uint32_t part = stock.part_of_level[p][levels[p]];
      models.back().parts.push_back({&atlas.room.parts[part], &atlas.uv[part]});
    }
  }
  return models;
}

/// The same for light, by number.
light::DrawnParts parts_of(const Stock& stock, const Choice& choice) {
  light::DrawnParts parts{{}, choice.model_of_copy};
  for (const auto& levels : choice.models) {
    parts.models.emplace_back();
    for (std::size_t p = 0; p < levels.size(); ++p) parts.models.back().push_back(stock.part_of_level[p][levels[p]]);
  }
  return parts;
}

ToldLevels told(const place::PlacedMesh& part, const std::vector<Level>& levels) {
  ToldLevels of{part.name, {part.triangles.size()}, {0}};
  for (const Level& level : levels) of.triangles.push_back(level.mesh.triangles.size()), of.error.push_back(level.error);
  return of;
}

/// Gives the room a look of the colour expected beyond, and its mirrors panels of it.
void add_curtains(place::PlacedRoom& room, const scene::Color& color) {
  place::Look look;
  look.color = color;
  look.material.kind = scene::MaterialKind::emissive;   // it is the light itself
  room.looks.push_back(look);
  for (place::PlacedMesh& panel : curtains(room, static_cast<std::uint16_t>(room.looks.size() - 1))) room.parts.push_back(std::move(panel));
}

/// Why a scene cannot be compiled at all.
std::optional<Diagnostic> refusal(const Opened& opened, const CompileOptions& options, const std::vector<cover::Copy>& copies) {
  if (std::any_of(opened.room->mirrors.begin(), opened.room->mirrors.end(), [](const place::PlacedMirror& m) { return !(m.glow == scene::Color{}); })) {
    return make_error("driver.glowing-mirror", "a mirror that glows adds light to all that is seen in it: exports can only multiply",
                      "leave out `glow`, or draw the scene with the tracer (`orbc trace`)");
  }
  if (options.bend.view == bend::View::disk && std::any_of(copies.begin(), copies.end(), [](const cover::Copy& c) { return !c.sills.empty(); })) {
    return make_error("cover.stacked-mirrors", "the mirrors above each other that differ show their copies to one eye: --view disk has none",
                      "give them the same reflectance and tint, or leave out --view disk");
  }
  return std::nullopt;
}

/// The copies, once. Each takes at least its bytes.
Result<std::vector<cover::Copy>> unfolded(const Opened& opened, const CompileOptions& options, const Progress& progress) {
  if (!cover::needs_beams(*opened.room)) {
    const auto planned = cover::plan(*opened.room, opened.eye, opened.scene.cover, {options.max_memory / 2, false});
    if (!planned) return planned.error();
  }
  const auto most = static_cast<std::uint64_t>(static_cast<double>(options.max_memory / 2) / cover::kBytesPerCopy);
  return cover::unfold(*opened.room, opened.eye, opened.scene.cover, {std::min(most, cover::UnfoldOptions().max_copies), progress});
}

/// All that bending needs.
struct Ready {
  std::vector<cover::Copy> copies;
  Levels levels;
  Choice choice;
  Painted painted;
  std::vector<bend::Model> models;
  bend::BendOptions bending;
  std::uint64_t left_out = 0;
  LevelTally tally;
  Beyond beyond;
  std::vector<std::uint32_t> without_curtains;   ///< the models as they are without the tail
};

/// Levels of detail, and what a budget of triangles leaves. Makes: why it cannot be met, or nothing.
Diagnostics choose_detail(const Opened& opened, const CompileOptions& options, Ready& ready, const Executor& executor, const Progress& progress) {
  const bool for_eye = options.bend.view == bend::View::eye;
  report(progress, "levels of detail", 0, 0);
  if (options.levels && for_eye) ready.levels = make_levels(*opened.room, executor);
  else ready.levels.resize(opened.room->parts.size());
  if (options.budget && for_eye) {
    auto fitted = fit_to_budget(*opened.room, ready.levels, ready.copies, opened.eye, *options.budget, ready.bending, executor, progress);
    if (!fitted) return fitted.error();
    ready.copies = std::move(fitted->copies);
    ready.choice = std::move(fitted->choice);
    ready.bending.tolerance_px = fitted->tolerance_px;
    ready.left_out = fitted->left_out;
  } else {
    ready.choice = for_eye ? choose_levels(*opened.room, ready.levels, ready.copies, opened.eye, ready.bending) : no_levels(*opened.room, ready.copies.size());
  }
  ready.tally = tally(*opened.room, ready.levels, ready.choice);
  return {};
}

Result<std::unique_ptr<Ready>> get_ready(const Opened& opened, const CompileOptions& options, const light::BakeOptions& baking, const Executor& executor,
                                         const Progress& progress) {
  auto ready = std::make_unique<Ready>();   // models point into it
  report(progress, "unfolding", 0, 0);
  if (const auto no = refusal(opened, options, {})) return *no;
  auto copies = unfolded(opened, options, progress);
  if (!copies) return copies.error();
  if (const auto no = refusal(opened, options, *copies)) return *no;
  ready->copies = std::move(copies).value();
  ready->bending = options.bend;
  ready->bending.colours_vary = options.bend.colours_vary || light::needs_bake(opened.scene, *opened.room);
  if (auto wrong = choose_detail(opened, options, *ready, executor, progress); !wrong.empty()) return wrong;
  Stock stock = stock_of(*opened.room, ready->levels, ready->choice);
  const bool expected = opened.expected_background && options.bend.view == bend::View::eye;
  const std::size_t first_curtain = stock.room.parts.size();
  if (options.bend.view == bend::View::eye) ready->beyond = look_beyond(opened, expected, executor);
  if (expected) add_curtains(stock.room, ready->beyond.color);
  report(progress, "atlas", 0, 0);
  ready->choice.model_of_copy.resize(ready->copies.size(), 0);
  PaintOptions painting = options.paint;
  painting.highlights = painting.highlights && options.bend.view == bend::View::eye;
  auto painted = paint(opened, stock.room, ready->copies, parts_of(stock, ready->choice), baking, painting, executor, progress);
  if (!painted) return painted.error();
  ready->painted = std::move(painted).value();
  ready->models = models_of(ready->painted.atlas, stock, ready->choice);
  add_highlights(ready->painted, ready->models, ready->choice.model_of_copy);
  ready->without_curtains = ready->choice.model_of_copy;
  std::vector<bend::Model::Part> curtain;
  for (std::size_t i = first_curtain; expected && i < stock.room.parts.size(); ++i) curtain.push_back({&ready->painted.atlas.room.parts[i], &ready->painted.atlas.uv[i]});
  if (expected) hang(*opened.room, opened.scene.cover, ready->copies, curtain, ready->models, ready->choice.model_of_copy);
  return ready;
}

Result<cover::Plan> estimated(const Opened& opened, const CompileOptions& options, const Ready& ready, const Executor& executor) {
  const auto bend_some = [&](const std::vector<std::size_t>& which) {
    std::vector<cover::Copy> copies;
    std::vector<std::uint32_t> models;
    for (const std::size_t i : which) {
      copies.push_back(ready.copies[i]);
      if (!ready.choice.model_of_copy.empty()) models.push_back(ready.choice.model_of_copy[i]);
    }
    return bend::bend(ready.painted.atlas.room, ready.models, models, copies, opened.eye, ready.bending, executor);
  };
  return estimate(*opened.room, opened.eye, ready.copies, opened.scene.cover.max_bounces, options.max_memory / 2, bend_some);
}

/// Whether the copies may take more than is allowed; splitting multiplies their triangles, but not by this.
bool may_exceed(const Opened& opened, const CompileOptions& options, const Ready& ready) {
  return cover::plan_of(ready.copies, *opened.room).bytes > options.max_memory / 64;
}

}  // namespace

Result<Compiled> compile(const Opened& opened, const CompileOptions& options, const Executor& executor, const Progress& progress) {
  auto prepared = get_ready(opened, options, light::bake_options(opened.scene.bake), executor, progress);
  if (!prepared) return located(prepared.error(), opened.scene.span);
  Ready& ready = **prepared;
  if (may_exceed(opened, options, ready))
    if (const auto planned = estimated(opened, options, ready, executor); !planned) return located(planned.error(), opened.scene.span);
  auto bent = bend::bend(ready.painted.atlas.room, ready.models, ready.choice.model_of_copy, ready.copies, opened.eye, ready.bending, executor, progress);
  if (bent && options.budget && bent->indices.size() / 3 > *options.budget)   // the tail is what one can do without
    bent = bend::bend(ready.painted.atlas.room, ready.models, ready.without_curtains, ready.copies, opened.eye, ready.bending, executor, progress);
  if (!bent) return located(bent.error(), opened.scene.span);

  Compiled compiled;
  Product& product = compiled.product;
  product.title = notation::to_text(opened.scene.orbifold);
  product.eye = opened.eye;
  product.background = opened.scene.cover.background;
  product.atlas = std::move(ready.painted.atlas.image);
  product.blended_atlas = ready.painted.baked;
  product.copies = drawn(ready.copies, bent->copies, opened.eye);
  for (std::size_t i = 0; i < product.copies.size(); ++i) product.copies[i].level = ready.tally.level_of_copy[i];
  product.positions = std::move(bent->positions);
  product.uv = std::move(bent->uv);
  product.indices = std::move(bent->indices);
  product.flat_view = options.bend.view == bend::View::disk;

  Report& r = compiled.report;
  r.copies = product.copies.size(), r.vertices = product.positions.size(), r.triangles = product.indices.size() / 3;
  r.error_bound_px = bent->error_bound_px + ready.choice.error_px;
  r.highlights = ready.painted.highlights.counts;
  r.weight_lost = ready.beyond.weight_lost;
  r.triangles_whole = r.triangles + ready.tally.saved;
  r.tolerance_px = ready.bending.tolerance_px, r.left_out = ready.left_out;
  std::set<std::string> words;
  for (const DrawnCopy& copy : product.copies) words.insert(cover::to_string(copy.word)), r.beams += copy.wedge ? 1 : 0;
  r.words = words.size();
  for (std::size_t p = 0; p < ready.levels.size(); ++p)
    if (!ready.levels[p].empty()) r.levels.push_back(told(opened.room->parts[p], ready.levels[p]));
  for (const DrawnCopy& copy : product.copies) r.longest_word = std::max(r.longest_word, static_cast<int>(copy.word.size()));
  return compiled;
}

Result<cover::Plan> plan(const Opened& opened, const CompileOptions& options, const Executor& executor) {
  // How fine the light is does not change what it is put on.
  light::BakeOptions coarse;
  coarse.coarse = coarse.fine = coarse.texture_fine = 0.01;
  coarse.passing = {1, 0.01};
  CompileOptions plain = options;
  plain.paint.highlights = false;
  const auto ready = get_ready(opened, plain, coarse, executor, {});
  if (!ready) return located(ready.error(), opened.scene.span);
  auto planned = estimated(opened, options, **ready, executor);
  if (!planned) return located(planned.error(), opened.scene.span);
  return planned;
}

std::string plan_json(const cover::Plan& p) {
  std::string per_bounces;
  for (const Integer& n : p.copies_per_bounces) per_bounces += (per_bounces.empty() ? "" : ", ") + to_string(n);
  return "{\n  \"copies\": " + to_string(p.copies) + ",\n  \"copies_per_bounces\": [" + per_bounces + "],\n  \"sheets\": " + std::to_string(p.sheets) +
         ",\n  \"triangles\": " + std::to_string(p.triangles) + ",\n  \"vertices\": " + std::to_string(p.vertices) + ",\n  \"bytes\": " + std::to_string(p.bytes) + "\n}\n";
}

Result<Tiling> tile(const Opened& opened, Tiling::Model model, Tiling::Colouring colouring) {
  auto copies = cover::unfold(*opened.room, opened.eye, opened.scene.cover);
  if (!copies) return located(copies.error(), opened.scene.span);
  std::vector<cover::Copy> first_sheet;
  for (cover::Copy& copy : *copies)
    if (copy.sheet == 0 && copy.storey.number == 0) first_sheet.push_back(std::move(copy));
  return Tiling{notation::to_text(opened.scene.orbifold), opened.room->room, std::move(first_sheet), model, colouring, opened.eye.room_from_eye};
}

/// Of a bearing, counter-clockwise from the x direction of the eye.
static double degrees_of(const cover::Bearing& b) { return std::atan2(b.y, b.x) * 180 / std::numbers::pi; }

std::string report_json(const Compiled& compiled) {
  const Report& r = compiled.report;
  nlohmann::ordered_json json{{"orbifold", compiled.product.title}, {"copies", r.copies}, {"vertices", r.vertices}, {"triangles", r.triangles},
                              {"triangles_without_levels", r.triangles_whole}, {"beams", r.beams}, {"words", r.words}, {"longest_word", r.longest_word},
                              {"error_bound_px", r.error_bound_px}, {"tolerance_px", r.tolerance_px}, {"copies_left_out", r.left_out}, {"weight_lost", r.weight_lost},
                              {"atlas", {compiled.product.atlas.width, compiled.product.atlas.height}},
                              {"highlights", {{"copies", r.highlights.copies}, {"copies_without", r.highlights.left_out}, {"texels", r.highlights.texels}}}};
  if (!r.levels.empty()) {
    nlohmann::ordered_json& levels = json["levels"] = nlohmann::ordered_json::array();
    for (const ToldLevels& of : r.levels) levels.push_back({{"part", of.part}, {"triangles", of.triangles}, {"error", of.error}});
  }
  nlohmann::ordered_json& list = json["list"] = nlohmann::ordered_json::array();
  for (const DrawnCopy& c : compiled.product.copies) {
    list.push_back({{"word", cover::to_string(c.word)}, {"bounces", c.bounces}, {"sheet", c.sheet}, {"mirrored", c.reversing}, {"weight", {c.tint.r, c.tint.g, c.tint.b}},
                    {"distance", c.distance}, {"triangles", c.index_count / 3}, {"level", c.level}});
    if (c.storey != 0) list.back()["storey"] = c.storey;
    if (c.wedge) list.back()["wedge_deg"] = {degrees_of(c.wedge->from), degrees_of(c.wedge->to)};
  }
  return json.dump(1) + "\n";
}

}  // namespace orbc::driver
