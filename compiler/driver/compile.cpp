#include "compiler/driver/compile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <set>

#include "compiler/base/elementary.h"
#include "compiler/cover/beam.h"
#include "compiler/cover/plan.h"
#include "compiler/cover/unfold.h"
#include "compiler/driver/budget.h"
#include "compiler/driver/by_object.h"
#include "compiler/driver/estimate.h"
#include "compiler/driver/fitting.h"
#include "compiler/driver/levels.h"
#include "compiler/driver/native.h"
#include "compiler/driver/renderer_scale.h"
#include "compiler/driver/tail.h"
#include "compiler/geometry/chart.h"
#include "compiler/notation/print.h"
#include "compiler/place/alpha_mask.h"

namespace orbc::driver {
namespace {

// The room's centre is the origin of its coordinates.
double distance_to(const cover::Copy& copy, const place::Camera& eye) {
  const geometry::Space space = eye.room_from_eye.space;
  return geometry::distance(space, copy.cover_from_room * geometry::Point(), eye.room_from_eye * geometry::Point());
}

std::vector<DrawnCopy> drawn(const std::vector<cover::Copy>& copies, const std::vector<bend::BentRange>& ranges, const place::Camera& eye) {
  std::vector<DrawnCopy> result;
  result.reserve(copies.size());
  for (std::size_t i = 0; i < copies.size(); ++i) {
    const cover::Copy& c = copies[i];
    const bend::BentRange& r = ranges[i];
    result.push_back({r.first_vertex, r.vertex_count, r.first_index, r.index_count, c.weight, c.word, c.bounces, c.sheet,
                      c.cover_from_room.reversing, distance_to(c, eye), c.storey.number, 0, c.wedge});
  }
  return result;
}

/// What the copies are drawn from.
std::vector<bend::Model> models_of(const bake::Atlas& atlas, const Stock& stock, const Choice& choice) {
  std::vector<bend::Model> models;
  for (const auto& levels : choice.models) {
    models.emplace_back();
    for (std::size_t p = 0; p < levels.size(); ++p) {
      const std::uint32_t part = stock.part_of_level[p][levels[p]];
      models.back().parts.push_back({&atlas.room.parts[part], &atlas.uv[part], false});
    }
  }
  return models;
}

/// The same for light, by number.
bake::DrawnParts parts_of(const Stock& stock, const Choice& choice) {
  bake::DrawnParts parts{{}, choice.model_of_copy, stock.beside};
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

/// Why a scene cannot be compiled at all.
std::optional<Diagnostic> refusal(const Opened& opened, const CompileOptions& options, const std::vector<cover::Copy>& copies) {
  if (std::any_of(opened.room->mirrors.begin(), opened.room->mirrors.end(),
                  [](const place::PlacedMirror& m) { return !(m.emission == scene::Color{}); })) {
    return make_error("driver.glowing-mirror", "a mirror that glows adds light to all that is seen in it: exports can only multiply",
                      "leave out `glow`, or draw the scene with the tracer (`orbc trace`)");
  }
  if (options.bend.view == bend::View::disk &&
      std::any_of(copies.begin(), copies.end(), [](const cover::Copy& c) { return !c.height_bounds.empty(); })) {
    return make_error("cover.stacked-mirrors",
                      "the mirrors above each other that differ show their copies to one eye: --view disk has none",
                      "give them the same reflectance and tint, or leave out --view disk");
  }
  return std::nullopt;
}

/// The copies, once. Each takes at least its bytes.
Result<std::vector<cover::Copy>> unfolded(const Opened& opened, const CompileOptions& options, const Progress& progress) {
  if (!cover::needs_beams(*opened.room)) {
    const auto planned = cover::plan(*opened.room, opened.eye, opened.scene.cover, {options.max_memory / 2});
    if (!planned) return planned.error();
  }
  const double each = cover::needs_beams(*opened.room) ? cover::kBytesPerBeam : cover::kBytesPerCopy;
  const auto most = static_cast<std::uint64_t>(static_cast<double>(options.max_memory / 2) / each);
  return cover::unfold(*opened.room, opened.eye, opened.scene.cover, {std::min(most, cover::UnfoldOptions().max_copies), progress});
}

constexpr std::uint64_t kMany = 1'000'000;  // triangles before splitting: from here on it pays to look ahead

/// All that bending needs.
struct Ready {
  std::vector<cover::Copy> copies;
  Levels levels;
  Choice choice;
  Painted painted;
  std::vector<bend::Model> models;
  bend::BendOptions bending;
  std::uint64_t left_out = 0, curtains = 0;
  double left_out_px = 0;
  bool hangs = false;  ///< whether there are panels in mirrors at all
  bool curtains_dropped = false;
  LevelTally tally;
  Beyond beyond;
  std::vector<Shine> shine;  ///< per copy, where what glows has copies of its own
  ByObject objects;          ///< where copies stand object by object
};

/// What is done for the product itself, and left undone where only its triangles are asked for.
enum class Purpose { product, plan };

/// Levels of detail, and what a budget of triangles leaves. Makes: why it cannot be met, or nothing.
Diagnostics choose_detail(const Opened& opened, const CompileOptions& options, Ready& ready, const Executor& executor,
                          const Progress& progress) {
  const bool for_eye = options.bend.view == bend::View::eye;
  report(progress, "levels of detail", 0, 0);
  if (options.levels && for_eye) ready.levels = make_levels(*opened.room, executor);
  else ready.levels.resize(opened.room->parts.size());
  ready.hangs = for_eye;
  if (options.budget && for_eye) {
    auto fitted =
        fit_to_budget(opened, ready.levels, ready.copies, *options.budget, ready.bending, shows_beyond(opened), executor, progress);
    if (!fitted) return fitted.error();
    ready.copies = std::move(fitted->copies);
    ready.choice = std::move(fitted->choice);
    ready.bending.tolerance_px = fitted->tolerance_px;
    ready.bending.max_triangles = bending_limit(*options.budget);
    ready.left_out = fitted->left_out, ready.left_out_px = fitted->left_out_px;
    ready.hangs = fitted->curtains;
    ready.curtains_dropped = !fitted->curtains && (shows_beyond(opened) || opened.scene.cover.min_pixels > 0 || fitted->left_out > 0);
  } else {
    ready.choice = for_eye ? choose_levels(*opened.room, ready.levels, ready.copies, opened.eye, ready.bending)
                           : no_levels(*opened.room, ready.copies.size());
  }
  ready.choice.model_of_copy.resize(ready.copies.size(), 0);
  ready.tally = tally(*opened.room, ready.levels, ready.choice);
  return {};
}

/// Radiance as it is shown: what the twin of a lit scene draws as it is.
void show(double exposure, Beyond& beyond) {
  beyond.color = exposure * beyond.color;
  for (scene::Color& color : beyond.by_height) color = exposure * color;
}

/// What lies beyond the cover's end. In: as in `make`. Where only a weight is asked for, the room need not be looked at closely.
Beyond look(const Opened& opened, const Opened* lit, const Ready& ready, bool expected, const LeftOut& left_out, Purpose purpose,
            const Executor& executor) {
  constexpr double kRough = 0.004;  // of the room's radius
  const std::vector<double> bands = left_out ? bands_of(*opened.room, opened.eye) : std::vector<double>{};
  // Panels are exposed like everything else, the background is not.
  const scene::Color background = (opened.scene.exposure > 0 ? 1 / opened.scene.exposure : 1) * opened.scene.cover.background;
  if (purpose == Purpose::plan) return {0, 0, background, std::vector<scene::Color>(bands.size() + 1)};
  if (expected || left_out) {
    const Opened& seen = lit ? *lit : opened;
    Beyond beyond = look_beyond(seen, *seen.room, {expected, left_out, bands}, executor);
    if (lit) show(lit->scene.exposure, beyond);
    if (!expected) beyond.color = background;
    return beyond;
  }
  Beyond beyond = look_beyond(opened, rough(*opened.room, ready.levels, kRough * opened.room->polygon.circumradius), {}, executor);
  beyond.color = background;
  return beyond;
}

/// Colours and models: of parts, levels, highlights and panels.
Diagnostics dress(const Opened& opened, const Opened* lit, const CompileOptions& options, Ready& ready, Purpose purpose,
                  const Executor& executor, const Progress& progress) {
  Stock stock = stock_of(*opened.room, ready.levels, ready.choice);
  const bool for_eye = options.bend.view == bend::View::eye, expected = ready.hangs && opened.expected_background;
  const bool ends = ready.hangs && shows_beyond(opened);
  const LeftOut left_out = ready.hangs ? left_out_below(opened, ready.left_out_px) : LeftOut{};
  if (for_eye) ready.beyond = look(opened, lit, ready, expected, left_out, purpose, executor);
  const bool flat = may_be_flat(*opened.room, std::max(opened.scene.cover.min_pixels, ready.left_out_px));
  std::vector<std::size_t> plain, banded;
  if (ends) plain = add_curtains(stock.room, {ready.beyond.color}, {}, false);
  if (left_out) banded = add_curtains(stock.room, ready.beyond.by_height, bands_of(*opened.room, opened.eye), flat);
  report(progress, "atlas", 0, 0);
  PaintOptions painting = options.paint;
  painting.highlights = painting.highlights && for_eye;
  painting.lit = purpose == Purpose::product;
  painting.with_image16 = opened.scene.bake.atlas != scene::AtlasFormat::srgb8;
  auto painted = paint(opened, stock.room, ready.copies, parts_of(stock, ready.choice), bake::bake_options(opened.scene.bake), painting,
                       executor, progress);
  if (!painted) return painted.error();
  ready.painted = std::move(painted).value();
  ready.models = models_of(ready.painted.atlas, stock, ready.choice);
  add_highlights(ready.painted, ready.models, ready.choice.model_of_copy);
  const auto panels = [&](const std::vector<std::size_t>& parts, bool unsplit) {
    std::vector<bend::Model::Part> of;
    for (const std::size_t i : parts) of.push_back({&ready.painted.atlas.room.parts[i], &ready.painted.atlas.uv[i], unsplit});
    return of;
  };
  ready.curtains = hang(CutOffs(*opened.room, opened.scene.cover, left_out), ready.copies, {panels(plain, false), panels(banded, flat)},
                        ready.models, ready.choice.model_of_copy);
  return {};
}

Result<std::unique_ptr<Ready>> get_ready(const Opened& opened, const Opened* lit, const CompileOptions& options, Purpose purpose,
                                         const Executor& executor, const Progress& progress) {
  auto ready = std::make_unique<Ready>();  // models point into it
  report(progress, "unfolding", 0, 0);
  if (const auto no = refusal(opened, options, {})) return *no;
  auto copies = unfolded(opened, options, progress);
  if (!copies) return copies.error();
  if (const auto no = refusal(opened, options, *copies)) return *no;
  ready->copies = std::move(copies).value();
  ready->bending = options.bend;
  ready->bending.colors_vary = options.bend.colors_vary || bake::needs_bake(opened.scene, *opened.room);
  if (auto wrong = choose_detail(opened, options, *ready, executor, progress); !wrong.empty()) return wrong;
  if (purpose == Purpose::product && options.foresee && ready->tally.triangles > kMany)
    if (const auto planned = plan(opened, options, executor)) options.foresee(*planned);
  if (auto wrong = dress(opened, lit, options, *ready, purpose, executor, progress); !wrong.empty()) return wrong;
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
    return bend::bend(ready.painted.atlas.room, {copies, ready.models, models}, opened.eye, ready.bending, executor);
  };
  cover::Contents contents{opened.room.get(), {}, ready.choice.model_of_copy};
  for (const bend::Model& model : ready.models) {
    contents.models.emplace_back();
    for (const bend::Model::Part& part : model.parts) contents.models.back().push_back(part.mesh);
  }
  return estimate(contents, opened.eye, ready.copies, opened.scene.cover.max_bounces, options.max_memory / 2, bend_some);
}

/// Draws what glows, and what belongs to lamps, as copies of their own behind the others: the parts of every model are parted.
void part_what_glows(Ready& ready) {
  const std::size_t whole = ready.copies.size(), models = ready.models.size();
  const place::Interior& room = ready.painted.atlas.room;
  std::array<std::vector<bend::Model>, 3> parted;
  for (std::vector<bend::Model>& own : parted) own.resize(models);
  for (std::size_t m = 0; m < models; ++m)
    for (const bend::Model::Part& part : ready.models[m].parts)
      parted[static_cast<std::size_t>(shine_of(room, *part.mesh))][m].parts.push_back(part);
  ready.models = std::move(parted[0]);
  ready.shine.assign(whole, Shine::lit);
  for (const Shine shine : {Shine::glowing, Shine::lamp}) {
    std::vector<bend::Model>& own = parted[static_cast<std::size_t>(shine)];
    const auto first = static_cast<std::uint32_t>(ready.models.size());
    for (std::size_t c = 0; c < whole; ++c) {
      const std::uint32_t model = ready.choice.model_of_copy[c];
      if (own[model].parts.empty()) continue;
      ready.copies.push_back(ready.copies[c]);
      ready.shine.push_back(shine);
      ready.tally.level_of_copy.push_back(ready.tally.level_of_copy[c]);
      ready.choice.model_of_copy.push_back(first + model);
    }
    std::move(own.begin(), own.end(), std::back_inserter(ready.models));
  }
}

/// Draws every object's copies together: each copy as often as it shows objects.
void part_objects(Ready& ready) {
  ready.objects = part_by_object(ready.painted.atlas.room, ready.models, ready.choice.model_of_copy);
  for (std::size_t i = ready.copies.size(); i < ready.objects.copy_of_entry.size(); ++i) {
    const std::size_t of = ready.objects.copy_of_entry[i];
    ready.copies.push_back(ready.copies[of]);
    ready.tally.level_of_copy.push_back(ready.tally.level_of_copy[of]);
    if (!ready.shine.empty()) ready.shine.push_back(ready.shine[of]);
  }
}

/// Whether the copies may take more than is allowed; splitting multiplies their triangles, but not by this.
bool may_exceed(const CompileOptions& options, const Ready& ready) {
  constexpr double kSplit = 32;
  const auto triangles = static_cast<double>(ready.tally.triangles), copies = static_cast<double>(ready.copies.size());
  // A closed surface has half as many vertices as triangles; where looks meet, some more.
  const double bytes = triangles * (cover::kBytesPerTriangle + cover::kBytesPerVertex) + copies * cover::kBytesPerCopy;
  return kSplit * bytes > static_cast<double>(options.max_memory) / 2;
}

struct Made {
  std::unique_ptr<Ready> ready;
  bend::BentCover bent;
};

/// In: `lit`: the scene whose lamps are to be hung into the product, opened is then its twin; or none.
Result<Made> make(const Opened& opened, const Opened* lit, const CompileOptions& options, const Executor& executor,
                  const Progress& progress) {
  auto prepared = get_ready(opened, lit, options, Purpose::product, executor, progress);
  if (!prepared) return prepared.error();
  Ready& ready = **prepared;
  if (lit) part_what_glows(ready);
  if (may_exceed(options, ready))
    if (const auto planned = estimated(opened, options, ready, executor); !planned) return planned.error();
  if (options.by_object) part_objects(ready);
  auto bent = bend::bend(ready.painted.atlas.room, {ready.copies, ready.models, ready.choice.model_of_copy}, opened.eye, ready.bending,
                         executor, progress);
  if (!bent) return bent.error();
  return Made{std::move(prepared).value(), std::move(bent).value()};
}

/// The same, never above the budget. That is met before there are colours; a baked picture cuts surfaces into blocks, whose triangles may
/// be split in another order, and then a few more may come of it.
Result<Made> make_within(const Opened& opened, const Opened* lit, const CompileOptions& options, const Executor& executor,
                         const Progress& progress) {
  constexpr int kTries = 4;
  CompileOptions tried = options;
  for (int i = 0;; ++i) {
    auto made = make(opened, lit, tried, executor, progress);
    if (!made || !options.budget || options.bend.view != bend::View::eye) return made;
    const std::uint64_t triangles = made->bent.indices.size() / 3;
    if (triangles <= *options.budget) return made;
    if (i == kTries)
      return make_error("bend.too-dense", fmt::format("{} triangles come out where {} are allowed", triangles, *options.budget),
                        "allow more with --max-triangles");
    tried.budget = *tried.budget - std::min(*tried.budget, 2 * (triangles - *options.budget));
  }
}

Diagnostics notes_of(const Opened& opened, const CompileOptions& options, const Ready& ready) {
  Diagnostics notes;
  if (opened.eye.lens && options.bend.view == bend::View::eye)
    notes.push_back(make_warning("driver.no-lens",
                                 "exports belong to a pinhole: everything is sharp in them, the camera's lens is left out",
                                 "draw it with the tracer (`orbc trace`)", opened.scene.camera.lens->radius_span));
  const std::string budget = fmt::format("--max-triangles {}", options.budget.value_or(0));
  if (ready.left_out > 0)
    notes.push_back(make_warning(
        "driver.copies-left-out",
        fmt::format("{} leaves out {} copies that are smaller than {:.3g} px in the picture", budget, ready.left_out, ready.left_out_px),
        "allow more triangles, or lower cover.max_bounces"));
  if (ready.curtains_dropped)
    notes.push_back(
        make_warning("driver.no-curtains",
                     fmt::format("{} has no room for the panels that hide what is not drawn: the background is seen there", budget),
                     "allow more triangles"));
  return notes;
}

Result<cover::Plan> plan_once(const Opened& opened, const CompileOptions& options, const Executor& executor, const Progress& progress) {
  std::optional<Opened> twin;
  if (lit_natively(opened.scene)) twin.emplace(unlit_twin(opened));
  const Opened& from = twin ? *twin : opened;
  const auto ready = get_ready(from, nullptr, options, Purpose::plan, executor, progress);
  if (!ready) return ready.error();
  return estimated(from, options, **ready, executor);
}

/// Why the scene cannot be made, with a hint that was tried.
Diagnostics with_hint_for(Diagnostics errors, const Opened& opened, const CompileOptions& options, const Executor& executor,
                          const Progress& progress) {
  const auto fits = [&](int bounces) {
    constexpr double kSure = 1.2;  // an estimate's error
    const auto planned = plan_once(with_bounces(opened, bounces), options, executor, progress);
    return planned && kSure * static_cast<double>(planned->triangles) <= static_cast<double>(options.bend.max_triangles);
  };
  return located(with_tried_hint(std::move(errors), opened.scene.cover.max_bounces, fits), opened.scene.span);
}

Product product_of(const Opened& opened, const CompileOptions& options, Ready& ready, bend::BentCover bent) {
  Product product;
  product.title = notation::to_text(opened.scene.orbifold);
  product.eye = opened.eye;
  product.background = opened.scene.cover.background;
  product.atlas = std::move(ready.painted.atlas.image);
  product.atlas16 = std::move(ready.painted.atlas.image16);
  product.depth = opened.scene.bake.atlas;
  product.masked = place::has_alpha_mask(*opened.room);
  product.blended_atlas = ready.painted.baked;
  product.copies = drawn(ready.copies, bent.copies, opened.eye);
  for (std::size_t i = 0; i < product.copies.size(); ++i) product.copies[i].level = ready.tally.level_of_copy[i];
  for (std::size_t i = 0; i < ready.shine.size(); ++i) product.copies[i].shine = ready.shine[i];
  for (std::size_t i = 0; i < ready.objects.object_of_entry.size(); ++i) {
    product.copies[i].object = ready.objects.object_of_entry[i];
    if (ready.objects.copy_of_entry[i] != i) product.copies[i].again_of = ready.objects.copy_of_entry[i];
  }
  product.objects = ready.objects.names;
  product.positions = std::move(bent.positions);
  product.uv = std::move(bent.uv);
  product.indices = std::move(bent.indices);
  product.flat_view = options.bend.view == bend::View::disk;
  return product;
}

Report report_of(const Opened& opened, const Ready& ready, const Product& product, double bend_error_px) {
  Report r;
  r.copies = static_cast<std::uint64_t>(std::count_if(product.copies.begin(), product.copies.end(), is_listed));
  r.vertices = product.positions.size(), r.triangles = product.indices.size() / 3;
  r.error_bound_px = bend_error_px + ready.choice.error_px;
  r.highlights = ready.painted.view_counts;
  r.weight_lost = ready.beyond.weight_lost, r.weight_merged = ready.beyond.weight_merged;
  r.triangles_whole = r.triangles + ready.tally.saved;
  r.tolerance_px = kToleranceShares * ready.bending.tolerance_px;
  r.left_out = ready.left_out, r.left_out_px = ready.left_out_px;
  r.curtains = ready.curtains, r.curtains_dropped = ready.curtains_dropped;
  std::set<std::string> words;
  for (const DrawnCopy& copy : product.copies) {
    if (!is_listed(copy)) continue;
    words.insert(cover::to_string(copy.word));
    r.beams += copy.wedge ? 1 : 0;
    r.longest_word = std::max(r.longest_word, static_cast<int>(copy.word.size()));
  }
  r.words = words.size();
  for (std::size_t p = 0; p < ready.levels.size(); ++p)
    if (!ready.levels[p].empty()) r.levels.push_back(told(opened.room->parts[p], ready.levels[p]));
  return r;
}

}  // namespace

Result<Compiled> compile(const Opened& opened, const CompileOptions& options, const Executor& executor, const Progress& progress) {
  const bool native = lit_natively(opened.scene);
  if (native && options.bend.view != bend::View::eye) {
    return make_error("driver.native-view", "lamps of the renderer's own hang where one eye sees them: --view disk has none",
                      "bake the light (`lights: baked`), or leave out --view disk", opened.scene.span);
  }
  std::optional<Opened> twin;
  if (native) twin.emplace(unlit_twin(opened));
  const Opened& from = twin ? *twin : opened;
  auto made = make_within(from, native ? &opened : nullptr, options, executor, progress);
  if (!made) return with_hint_for(made.error(), from, options, executor, progress);
  Compiled compiled;
  const double bend_error_px = made->bent.error_bound_px;
  compiled.product = product_of(opened, options, *made->ready, std::move(made->bent));
  Diagnostics told_of_light;
  if (native) told_of_light = add_native_light(opened, made->ready->copies, compiled.product, executor);
  if (has_error(told_of_light)) return told_of_light;
  Diagnostics too_near = located(scale_for_renderers(compiled.product), opened.scene.camera.span);
  compiled.report = report_of(from, *made->ready, compiled.product, bend_error_px);
  compiled.notes = located(notes_of(opened, options, *made->ready), opened.scene.span);
  for (const Diagnostics* more : {&told_of_light, &too_near}) compiled.notes.insert(compiled.notes.end(), more->begin(), more->end());
  return compiled;
}

Result<cover::Plan> plan(const Opened& opened, const CompileOptions& options, const Executor& executor) {
  auto planned = plan_once(opened, options, executor, {});
  if (!planned) return with_hint_for(planned.error(), opened, options, executor, {});
  return planned;
}

Result<Tiling> tile(const Opened& opened, Tiling::Model model, Tiling::Colouring colouring) {
  auto copies = cover::unfold(*opened.room, opened.eye, opened.scene.cover);
  if (!copies) return located(copies.error(), opened.scene.span);
  std::vector<cover::Copy> first_sheet;
  for (cover::Copy& copy : *copies)
    if (copy.sheet == 0 && copy.storey.number == 0) first_sheet.push_back(std::move(copy));
  return Tiling{
      notation::to_text(opened.scene.orbifold), opened.room->polygon, std::move(first_sheet), model, colouring, opened.eye.room_from_eye};
}

}  // namespace orbc::driver
