// The largest error of a picture is smallest when all copies share one tolerance. So a single number is searched: it is doubled until the
// budget is met, then bisected on its logarithm. Each step bends for real, without colors, on which no triangle depends: how many triangles
// splitting and cutting make cannot be predicted exactly.
#include "compiler/lod/budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "compiler/bend/screen_size.h"

namespace orbc::lod {
namespace {

constexpr int kMaxDoublings = 24;
constexpr double kToleranceRatio = 1.0 / 16;  // precision of the bisection
constexpr double kCullFromPx = 1;             // coarser than that would be seen sooner than missing copies

/// What may be given up to meet a budget.
struct BudgetPolicy {
  bool may_cull = false, has_impostors = true;
};

/// Bends the scene at one tolerance after the other.
/// Invariant: `uv_` holds a list of the right length for every mesh that bends; `sizes_px_` are those of the copies.
class BudgetSearch {
 public:
  BudgetSearch(const BudgetScene& scene, const std::vector<cover::Copy>& copies, std::uint64_t budget, const bend::BendOptions& options,
               const Executor& executor)
      : scene_(scene), copies_(copies), budget_(budget), options_(options), executor_(executor) {
    options_.advise = false;
    options_.max_triangles = bending_limit(budget);
    for (const place::PlacedMesh* mesh : scene.drawn) uv_[mesh].resize(mesh->floor.size());
    for (const auto* panels : {&scene.panels.depth, &scene.panels.size, &scene.panels.size_unsplit})
      for (const place::PlacedMesh& panel : *panels) uv_[&panel].resize(panel.floor.size());
    const place::Interior& room = scene.lods.interior;
    const bend::ScreenSize detail(scene.eye, options);
    const bend::BoundingCylinder whole{{}, room.polygon.circumradius, 0, room.height};
    for (const cover::Copy& copy : copies) sizes_px_.push_back(detail.smaller_side_px(copy, whole));
  }

  /// Makes: nothing when the budget is exceeded.
  [[nodiscard]] std::optional<BudgetFit> try_tolerance(double tolerance_px, const BudgetPolicy& policy) {
    BudgetFit fit;
    fit.tolerance_px = options_.tolerance_px = tolerance_px;
    fit.has_impostors = policy.has_impostors;
    for (std::size_t i = 0; i < copies_.size(); ++i)
      if (copies_[i].bounces == 0 || !policy.may_cull || !(sizes_px_[i] < tolerance_px)) fit.copies.push_back(copies_[i]);
    fit.culled = copies_.size() - fit.copies.size();
    if (fit.culled > 0) fit.cull_px = tolerance_px;
    fit.selection = select_lods(scene_.lods, fit.copies, scene_.eye, options_);
    cutoff::ModelsWithImpostors drawn{models_of(fit.selection), fit.selection.model_of_copy, 0};
    if (policy.has_impostors) drawn = with_impostors(fit, std::move(drawn));
    const auto bent = bend::bend(scene_.lods.interior, {fit.copies, drawn.models, drawn.model_of_copy}, scene_.eye, options_, executor_);
    last_triangles_ = bent ? bent->indices.size() / 3 : 0;
    if (!bent || last_triangles_ > budget_) return std::nullopt;
    fit.triangles = last_triangles_;
    return fit;
  }

  /// Of the last try; 0: it had too many to be counted.
  [[nodiscard]] std::uint64_t last_triangles() const { return last_triangles_; }

 private:
  [[nodiscard]] cutoff::ModelsWithImpostors with_impostors(const BudgetFit& fit, cutoff::ModelsWithImpostors drawn) const {
    const place::Interior& room = scene_.lods.interior;
    const cutoff::Endings endings(room, scene_.cover, cutoff::cull_below(room, scene_.eye, scene_.cover, fit.cull_px));
    const bool unsplit = cutoff::can_skip_splitting(room, std::max(scene_.cover.min_pixels, fit.cull_px));
    const cutoff::Impostors impostors{parts_of(scene_.panels.depth, false),
                                      parts_of(unsplit ? scene_.panels.size_unsplit : scene_.panels.size, unsplit)};
    return cutoff::attach_impostors(endings, fit.copies, impostors, std::move(drawn.models), std::move(drawn.model_of_copy));
  }

  [[nodiscard]] std::vector<bend::Model::Part> parts_of(const std::vector<place::PlacedMesh>& panels, bool unsplit) const {
    std::vector<bend::Model::Part> parts;
    for (const place::PlacedMesh& panel : panels) parts.push_back({&panel, &uv_.at(&panel), unsplit});
    return parts;
  }

  [[nodiscard]] std::vector<bend::Model> models_of(const LodSelection& selection) const {
    std::vector<bend::Model> models;
    for (const std::vector<std::uint16_t>& levels : selection.levels_of_model) {
      models.emplace_back();
      for (std::size_t p = 0; p < levels.size(); ++p) {
        const place::PlacedMesh* mesh = scene_.drawn[scene_.lods.part_of_level[p][levels[p]]];
        models.back().parts.push_back({mesh, &uv_.at(mesh), false});
      }
    }
    return models;
  }

  const BudgetScene& scene_;
  const std::vector<cover::Copy>& copies_;
  std::uint64_t budget_;
  bend::BendOptions options_;
  const Executor& executor_;
  std::map<const place::PlacedMesh*, bend::Uv> uv_;  // looked up only
  std::vector<double> sizes_px_;
  std::uint64_t last_triangles_ = 0;
};

/// Searches the smallest tolerance that fits, from one that does not.
/// Makes: nothing when none up to `max_px` fits.
std::optional<BudgetFit> bisect_tolerance(BudgetSearch& search, double low_px, double max_px, const BudgetPolicy& policy,
                                          const Progress& progress) {
  std::optional<BudgetFit> best;
  double high_px = low_px;
  for (int i = 0; i < kMaxDoublings && !best; ++i) {
    if (high_px >= max_px) return std::nullopt;
    low_px = high_px;
    high_px = std::min(2 * high_px, max_px);
    report(progress, "fitting", static_cast<std::uint64_t>(i), kMaxDoublings);
    best = search.try_tolerance(high_px, policy);
  }
  while (best && high_px > low_px * (1 + kToleranceRatio)) {
    const double middle_px = std::sqrt(low_px * high_px);
    auto fit = search.try_tolerance(middle_px, policy);
    if (fit) {
      best = std::move(fit);
      high_px = middle_px;
    } else {
      low_px = middle_px;
    }
  }
  return best;
}

}  // namespace

std::uint64_t bending_limit(std::uint64_t budget) { return std::max(budget, 4 * budget + 100'000); }

Result<BudgetFit> fit_to_budget(const BudgetScene& scene, const std::vector<cover::Copy>& copies, std::uint64_t budget,
                                const bend::BendOptions& options, const Executor& executor, const Progress& progress) {
  BudgetSearch search(scene, copies, budget, options, executor);
  report(progress, "fitting", 0, 0);
  const double wanted_px = options.tolerance_px, max_px = std::ldexp(wanted_px, kMaxDoublings);
  std::optional<BudgetFit> best = search.try_tolerance(wanted_px, {});
  if (!best) best = bisect_tolerance(search, wanted_px, kCullFromPx, {}, progress);
  if (!best) best = bisect_tolerance(search, wanted_px, max_px, {true, true}, progress);
  if (!best) best = bisect_tolerance(search, wanted_px, max_px, {true, false}, progress);
  if (best) return std::move(*best);
  const std::uint64_t needed = search.last_triangles();
  return make_error("bend.too-dense", fmt::format("not even the room itself at its coarsest fits into {} triangles", budget),
                    needed > 0 ? fmt::format("it takes {}: --max-triangles {} fits", needed, needed) : "allow more with --max-triangles");
}

}  // namespace orbc::lod
