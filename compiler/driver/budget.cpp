// Minimax: the picture's largest error is smallest when all copies share one tolerance. So a single number is searched: doubled until the budget is met,
// then bisected on its logarithm. Each step bends for real (without colours, which no triangle depends on): splitting and cutting cannot be guessed exactly.
#include "compiler/driver/budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace orbc::driver {
namespace {

constexpr int kDoublings = 24;
constexpr double kClose = 1.0 / 16;

class Search {
 public:
  Search(const place::PlacedRoom& room, const Levels& levels, const std::vector<cover::Copy>& copies, const place::Eye& eye, std::uint64_t budget,
         const bend::BendOptions& options, const Executor& executor)
      : room_(room), levels_(levels), copies_(copies), eye_(eye), budget_(budget), options_(options), executor_(executor) {
    options_.advise = false;
    // Cutting may take back what was too much before; but no attempt shall take much more memory than the outcome.
    options_.max_triangles = 4 * budget + 100'000;
    for (const place::PlacedMesh& part : room.parts) no_uv_.emplace_back(part.floor.size());
    for (const auto& of_part : levels)
      for (const Level& level : of_part) level_uv_[&level].resize(level.mesh.floor.size());
    const bend::Detail detail(eye, options);
    const bend::Extent whole{{}, room.room.circumradius, 0, room.height};
    for (const cover::Copy& copy : copies) sizes_.push_back(detail.smaller_side_px(copy, whole));
  }

  /// What comes out at a tolerance; nothing when it is too much.
  std::optional<Fitted> at(double tolerance) {
    Fitted fitted;
    fitted.tolerance_px = options_.tolerance_px = tolerance;
    for (std::size_t i = 0; i < copies_.size(); ++i) {
      // At the tolerance asked for everything is drawn.
      if (copies_[i].bounces == 0 || !leave_out_ || !(sizes_[i] < tolerance)) fitted.copies.push_back(copies_[i]);
    }
    fitted.left_out = copies_.size() - fitted.copies.size();
    fitted.choice = choose_levels(room_, levels_, fitted.copies, eye_, options_);
    std::vector<bend::Model> models;
    for (const auto& choice : fitted.choice.models) {
      models.emplace_back();
      for (std::size_t p = 0; p < choice.size(); ++p) {
        if (choice[p] == 0) models.back().parts.push_back({&room_.parts[p], &no_uv_[p]});
        else models.back().parts.push_back({&levels_[p][choice[p] - 1].mesh, &level_uv_[&levels_[p][choice[p] - 1]]});
      }
    }
    const auto bent = bend::bend(room_, models, fitted.choice.model_of_copy, fitted.copies, eye_, options_, executor_);
    least_ = bent ? bent->indices.size() / 3 : 0;
    if (!bent || least_ > budget_) return std::nullopt;
    fitted.triangles = least_;
    return fitted;
  }

  void leave_out() { leave_out_ = true; }
  [[nodiscard]] std::uint64_t last_count() const { return least_; }

 private:
  const place::PlacedRoom& room_;
  const Levels& levels_;
  const std::vector<cover::Copy>& copies_;
  const place::Eye& eye_;
  std::uint64_t budget_;
  bend::BendOptions options_;
  const Executor& executor_;
  std::vector<bend::Uv> no_uv_;
  std::map<const Level*, bend::Uv> level_uv_;
  std::vector<double> sizes_;
  bool leave_out_ = false;
  std::uint64_t least_ = 0;
};

}  // namespace

Result<Fitted> fit_to_budget(const place::PlacedRoom& room, const Levels& levels, const std::vector<cover::Copy>& copies, const place::Eye& eye,
                             std::uint64_t budget, const bend::BendOptions& options, const Executor& executor, const Progress& progress) {
  Search search(room, levels, copies, eye, budget, options, executor);
  report(progress, "fitting", 0, 0);
  std::optional<Fitted> best = search.at(options.tolerance_px);
  if (best) return std::move(*best);
  search.leave_out();
  double low = options.tolerance_px, high = low;
  for (int i = 0; i < kDoublings && !best; ++i) {
    low = high, high *= 2;
    report(progress, "fitting", static_cast<std::uint64_t>(i), kDoublings);
    best = search.at(high);
  }
  if (!best) {
    const std::uint64_t least = search.last_count();
    return make_error("bend.too-dense", fmt::format("not even the room itself at its coarsest fits into {} triangles", budget),
                      least > 0 ? fmt::format("it takes {}: --max-triangles {} fits", least, least) : "allow more with --max-triangles");
  }
  while (high > low * (1 + kClose)) {
    const double middle = std::sqrt(low * high);
    auto fitted = search.at(middle);
    if (fitted) best = std::move(fitted), high = middle;
    else low = middle;
  }
  return std::move(*best);
}

}  // namespace orbc::driver
