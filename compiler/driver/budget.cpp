// Minimax: the picture's largest error is smallest when all copies share one tolerance. So a single number is searched: doubled until the
// budget is met, then bisected on its logarithm. Each step bends for real (without colours, which no triangle depends on): splitting and
// cutting cannot be guessed exactly.
#include "compiler/driver/budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "compiler/bend/screen_size.h"

namespace orbc::driver {
namespace {

constexpr int kDoublings = 24;
constexpr double kClose = 1.0 / 16;
constexpr double kAllCopies = 1;   // pixels: coarser than that would be seen sooner than what is left out

/// What may be done to meet a budget.
struct Means {
  bool leave_out = false, curtains = true;
};

class Search {
 public:
  Search(const Opened& opened, const Levels& levels, const std::vector<cover::Copy>& copies, std::uint64_t budget,
         const bend::BendOptions& options, bool expected, const Executor& executor)
      : opened_(opened),
        room_(*opened.room),
        levels_(levels),
        copies_(copies),
        budget_(budget),
        options_(options),
        expected_(expected),
        executor_(executor) {
    options_.advise = false;
    options_.max_triangles = bending_limit(budget);
    for (const place::PlacedMesh& part : room_.parts) no_uv_.emplace_back(part.floor.size());
    for (const auto& of_part : levels)
      for (const Level& level : of_part) level_uv_[&level].resize(level.mesh.floor.size());
    // Their looks are none of the room's yet.
    const auto no_look = static_cast<std::uint16_t>(room_.styles.size());
    plain_panels_ = curtains(room_, no_look);
    banded_panels_ = curtains(room_, no_look, bands_of(room_, opened.eye));
    flat_panels_ = curtains(room_, no_look, bands_of(room_, opened.eye), true);
    for (const auto* panels : {&plain_panels_, &banded_panels_, &flat_panels_})
      for (const place::PlacedMesh& panel : *panels) panel_uv_[&panel].resize(panel.floor.size());
    const bend::ScreenSize detail(opened.eye, options);
    const bend::BoundingCylinder whole{{}, room_.polygon.circumradius, 0, room_.height};
    for (const cover::Copy& copy : copies) sizes_.push_back(detail.smaller_side_px(copy, whole));
  }

  /// What comes out at a tolerance; nothing when it is too much.
  std::optional<Fitted> at(double tolerance, const Means& means) {
    Fitted fitted;
    fitted.tolerance_px = options_.tolerance_px = tolerance;
    fitted.curtains = means.curtains;
    for (std::size_t i = 0; i < copies_.size(); ++i)
      if (copies_[i].bounces == 0 || !means.leave_out || !(sizes_[i] < tolerance)) fitted.copies.push_back(copies_[i]);
    fitted.left_out = copies_.size() - fitted.copies.size();
    if (fitted.left_out > 0) fitted.left_out_px = tolerance;
    fitted.choice = choose_levels(room_, levels_, fitted.copies, opened_.eye, options_);
    std::vector<bend::Model> models = models_of(fitted.choice);
    std::vector<std::uint32_t> model_of_copy = fitted.choice.model_of_copy;
    if (means.curtains) {
      const CutOffs cut_offs(room_, opened_.scene.cover, left_out_below(opened_, fitted.left_out_px));
      const bool flat = may_be_flat(room_, std::max(opened_.scene.cover.min_pixels, fitted.left_out_px));
      const Curtains curtains{expected_ ? parts_of(plain_panels_, false) : std::vector<bend::Model::Part>{},
                              flat ? parts_of(flat_panels_, true) : parts_of(banded_panels_, false)};
      (void)hang(cut_offs, fitted.copies, curtains, models, model_of_copy);
    }
    const auto bent = bend::bend(room_, {fitted.copies, models, model_of_copy}, opened_.eye, options_, executor_);
    least_ = bent ? bent->indices.size() / 3 : 0;
    if (!bent || least_ > budget_) return std::nullopt;
    fitted.triangles = least_;
    return fitted;
  }

  [[nodiscard]] std::uint64_t last_count() const { return least_; }

 private:
  [[nodiscard]] std::vector<bend::Model::Part> parts_of(const std::vector<place::PlacedMesh>& panels, bool flat) const {
    std::vector<bend::Model::Part> parts;
    for (const place::PlacedMesh& panel : panels) parts.push_back({&panel, &panel_uv_.at(&panel), flat});
    return parts;
  }

  [[nodiscard]] std::vector<bend::Model> models_of(const Choice& all) const {
    std::vector<bend::Model> models;
    for (const auto& choice : all.models) {
      models.emplace_back();
      for (std::size_t p = 0; p < choice.size(); ++p) {
        if (choice[p] == 0) models.back().parts.push_back({&room_.parts[p], &no_uv_[p], false});
        else models.back().parts.push_back({&levels_[p][choice[p] - 1].mesh, &level_uv_.at(&levels_[p][choice[p] - 1]), false});
      }
    }
    return models;
  }

  const Opened& opened_;
  const place::Interior& room_;
  const Levels& levels_;
  const std::vector<cover::Copy>& copies_;
  std::uint64_t budget_;
  bend::BendOptions options_;
  bool expected_;
  const Executor& executor_;
  std::vector<bend::Uv> no_uv_;
  std::map<const Level*, bend::Uv> level_uv_;             // looked up only
  std::vector<place::PlacedMesh> plain_panels_, banded_panels_, flat_panels_;
  std::map<const place::PlacedMesh*, bend::Uv> panel_uv_;
  std::vector<double> sizes_;
  std::uint64_t least_ = 0;
};

/// The smallest tolerance that fits, from one that does not; nothing if none up to `most` does.
std::optional<Fitted> smallest(Search& search, double low, double most, const Means& means, const Progress& progress) {
  std::optional<Fitted> best;
  double high = low;
  for (int i = 0; i < kDoublings && !best; ++i) {
    if (high >= most) return std::nullopt;
    low = high, high = std::min(2 * high, most);
    report(progress, "fitting", static_cast<std::uint64_t>(i), kDoublings);
    best = search.at(high, means);
  }
  while (best && high > low * (1 + kClose)) {
    const double middle = std::sqrt(low * high);
    auto fitted = search.at(middle, means);
    if (fitted) best = std::move(fitted), high = middle;
    else low = middle;
  }
  return best;
}

}  // namespace

std::uint64_t bending_limit(std::uint64_t budget) { return std::max(budget, 4 * budget + 100'000); }

Result<Fitted> fit_to_budget(const Opened& opened, const Levels& levels, const std::vector<cover::Copy>& copies, std::uint64_t budget,
                             const bend::BendOptions& options, bool expected, const Executor& executor, const Progress& progress) {
  Search search(opened, levels, copies, budget, options, expected, executor);
  report(progress, "fitting", 0, 0);
  const double asked = options.tolerance_px, endless = std::ldexp(asked, kDoublings);
  std::optional<Fitted> best = search.at(asked, {});
  if (!best) best = smallest(search, asked, kAllCopies, {}, progress);
  if (!best) best = smallest(search, asked, endless, {true, true}, progress);
  if (!best) best = smallest(search, asked, endless, {true, false}, progress);
  if (best) return std::move(*best);
  const std::uint64_t least = search.last_count();
  return make_error("bend.too-dense", fmt::format("not even the room itself at its coarsest fits into {} triangles", budget),
                    least > 0 ? fmt::format("it takes {}: --max-triangles {} fits", least, least) : "allow more with --max-triangles");
}

}  // namespace orbc::driver
