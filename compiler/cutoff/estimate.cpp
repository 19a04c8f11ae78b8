// A path that ends at a mirror shows weight × T, with T the radiance expected behind the mirror. Exports draw an impostor of color T in
// that mirror, and its copy multiplies it by the weight like everything else. Where paths end by depth, the tracer shows the same T, so
// that the sum over endless mirrors is closed instead of cut. Culled copies are seen by the tracer; T is then the mean of many small
// things, by the height at which one looks through the mirror.
#include "compiler/cutoff/estimate.h"

#include <algorithm>
#include <optional>

#include "compiler/notation/euler.h"
#include "compiler/notation/growth.h"
#include "compiler/render/radiance.h"

namespace orbc::cutoff {
namespace {

constexpr int kGridColumns = 64, kGridRows = 48;
constexpr int kCullGridFactor = 3;  // finer in both directions: paths into culled copies are few
constexpr int kExtraBounces = 96;   // beyond the cut-off
constexpr double kNegligibleWeight = 1e-4;

/// Radiance and weight of a bundle of paths.
struct PathSum {
  scene::Color weight, radiance;
  void add(const PathSum& more) {
    weight = weight + more.weight;
    radiance = radiance + more.radiance;
  }
  [[nodiscard]] bool empty() const { return !(max_channel(weight) > 0); }
  [[nodiscard]] scene::Color color() const {
    const auto ratio = [](double r, double w) { return w > 0 ? r / w : 0; };
    return {ratio(radiance.r, weight.r), ratio(radiance.g, weight.g), ratio(radiance.b, weight.b)};
  }
};

/// The sums over one row of the grid.
struct RowSums {
  PathSum depth;
  std::vector<PathSum> bands;
  double weight_lost = 0, weight_culled = 0;
};

/// Finds the first culled copy on a path.
class FirstCulledCopy {
 public:
  FirstCulledCopy(const place::Interior& room, const CutoffOptions& options) : room_(room), options_(options) {
    for (std::size_t wall = 0; wall < room_.polygon.walls.size(); ++wall)
      mirrors_.push_back(room::reflection_in_wall(room_.polygon, static_cast<int>(wall)));
    if (room_.polygon.space == geometry::Space::spherical && notation::is_orbifold(room_.polygon.orbifold))
      mirrors_per_half_turn_ = notation::longest_length(room_.polygon.orbifold).value_or(1);
  }

  /// The number of mirrors in front of it; the number of all mirrors of the path where no copy is culled.
  [[nodiscard]] std::size_t operator()(const std::vector<std::int16_t>& word) const {
    cover::Copy copy;
    copy.cover_from_room = geometry::identity(room_.polygon.space);
    int walls = 0;
    for (std::size_t i = 0; i < word.size(); ++i) {
      if (word[i] < 0) continue;  // a storey is as far away as the one before
      copy.cover_from_room = copy.cover_from_room * mirrors_[static_cast<std::size_t>(word[i])];
      copy.bounces = static_cast<int>(i) + 1;
      copy.sheet = mirrors_per_half_turn_ > 0 ? walls++ / mirrors_per_half_turn_ : 0;
      if (options_.is_culled(copy)) return i;
    }
    return word.size();
  }

 private:
  const place::Interior& room_;
  const CutoffOptions& options_;
  std::vector<geometry::Isometry> mirrors_;  // per wall
  int mirrors_per_half_turn_ = 0;            // of the sphere; 0: there are no half turns
};

/// The lighting without light between surfaces, where it has some: each ray would need many more.
std::optional<light::LightingContext> without_indirect_light(const light::LightingContext* lighting) {
  if (!lighting || lighting->options.indirect_bounces == 0) return std::nullopt;
  light::LightingContext direct = *lighting;
  direct.options.indirect_bounces = 0;
  return direct;
}

/// What the tracer shows in the scene's picture.
render::DrawOptions draw_options(const scene::Scene& scene, const light::LightingContext* lighting) {
  render::DrawOptions draw;
  draw.max_bounces = scene.cover.max_bounces;
  draw.min_weight = scene.cover.min_weight;
  draw.lighting = lighting && lighting->lit ? lighting : nullptr;
  draw.background = scene.exposure > 0 ? (1 / scene.exposure) * scene.cover.background : scene.cover.background;
  return draw;
}

/// Follows the rays of a grid.
class CutoffSampler {
 public:
  CutoffSampler(const ViewedScene& view, const CutoffOptions& options, const render::DrawOptions& shown, const Executor& executor)
      : view_(view),
        options_(options),
        executor_(executor),
        first_culled_(*view.tracer.interior, options),
        shown_(shown),
        followed_far_(shown) {
    followed_far_.background = {};
    followed_far_.max_bounces = shown.max_bounces + kExtraBounces;
    followed_far_.min_weight = kNegligibleWeight;
  }

  /// The paths that the tracer itself cuts off.
  [[nodiscard]] CutoffEstimate paths_cut_off() const {
    CutoffEstimate estimate{0, 0, view_.scene.cover.background, {}};
    PathSum all;
    for (const RowSums& row : rows(kGridColumns, kGridRows, [&](const trace::Ray&ray, RowSums&row) { add_cut_off(ray, row); })) {
      all.add(row.depth);
      estimate.weight_lost += row.weight_lost / (kGridColumns * kGridRows);
    }
    if (options_.wants_color && !all.empty()) estimate.color = all.color();
    return estimate;
  }

  /// Adds the paths that lead into culled copies. Where none is met, every band has the mean color of the picture.
  [[nodiscard]] CutoffEstimate with_culled(CutoffEstimate estimate) {
    if (options_.wants_color) shown_.background = estimate.color;
    constexpr int columns = kCullGridFactor * kGridColumns, lines = kCullGridFactor * kGridRows;
    std::vector<PathSum> bands(options_.bands.size() + 1);
    for (const RowSums& row : rows(columns, lines, [&](const trace::Ray&ray, RowSums&row) { add_culled(ray, row); })) {
      for (std::size_t b = 0; b < bands.size(); ++b) bands[b].add(row.bands[b]);
      estimate.weight_culled += row.weight_culled / (columns * lines);
    }
    PathSum all;
    for (const PathSum& band : bands) all.add(band);
    if (all.empty())
      for (const RowSums& row : rows(kGridColumns, kGridRows, [&](const trace::Ray&ray, RowSums&row) { add_any(ray, row); }))
        all.add(row.depth);
    for (const PathSum& band : bands) estimate.color_by_band.push_back(band.empty() ? all.color() : band.color());
    return estimate;
  }

 private:
  template <class Add>
  [[nodiscard]] std::vector<RowSums> rows(int columns, int lines, const Add& add) const {
    std::vector<RowSums> rows(static_cast<std::size_t>(lines));
    executor_(rows.size(), [&](std::size_t j) {
      rows[j].bands.resize(options_.bands.size() + 1);
      for (int i = 0; i < columns; ++i)
        add(render::eye_ray(view_.eye, (i + 0.5) * view_.eye.width / columns, (static_cast<double>(j) + 0.5) * view_.eye.height / lines),
            rows[j]);
    });
    return rows;
  }

  void add_cut_off(const trace::Ray& ray, RowSums& row) const {
    const trace::Path path = trace::follow(view_.tracer, ray, render::follow_options(shown_));
    if (!path.cut_off) return;
    row.weight_lost += max_channel(path.throughput);
    if (options_.wants_color) row.depth.add({path.throughput, render::radiance(view_.tracer, ray, followed_far_).radiance});
  }

  void add_culled(const trace::Ray& ray, RowSums& row) const {
    trace::FollowOptions follow = render::follow_options(shown_);
    follow.record_word = true;
    const trace::Path path = trace::follow(view_.tracer, ray, follow);
    const std::size_t mirrors = first_culled_(path.word);
    if (mirrors == path.word.size()) return;
    follow.max_bounces = static_cast<int>(mirrors);
    const trace::Path up_to_culled = trace::follow(view_.tracer, ray, follow);
    row.weight_culled += max_channel(up_to_culled.throughput);
    row.bands[band_of(up_to_culled, ray)].add({up_to_culled.throughput, render::radiance(view_.tracer, path, shown_).radiance});
  }

  void add_any(const trace::Ray& ray, RowSums& row) const {
    const render::RayResult seen = render::radiance(view_.tracer, ray, shown_);
    row.depth.add({seen.path.throughput, seen.radiance});
  }

  /// The band of heights in which the path ends.
  [[nodiscard]] std::size_t band_of(const trace::Path& path, const trace::Ray& ray) const {
    const double z = ray.z + path.length * ray.m;
    return static_cast<std::size_t>(std::upper_bound(options_.bands.begin(), options_.bands.end(), z) - options_.bands.begin());
  }

  const ViewedScene& view_;
  const CutoffOptions& options_;
  const Executor& executor_;
  FirstCulledCopy first_culled_;
  render::DrawOptions shown_, followed_far_;
};

}  // namespace

bool shows_cutoff(const scene::CoverSpec& spec) { return spec.background_expected || max_channel(spec.background) > 0; }

CutoffEstimate estimate_cutoff(const ViewedScene& view, const CutoffOptions& options, const Executor& executor) {
  const std::optional<light::LightingContext> direct = without_indirect_light(view.lighting);
  CutoffSampler sampler(view, options, draw_options(view.scene, direct ? &*direct : view.lighting), executor);
  CutoffEstimate estimate = sampler.paths_cut_off();
  return options.is_culled ? sampler.with_culled(std::move(estimate)) : estimate;
}

}  // namespace orbc::cutoff
