#include "compiler/driver/trace_film.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "compiler/bake/diffuse.h"
#include "compiler/cutoff/estimate.h"
#include "compiler/driver/straight.h"
#include "compiler/driver/unit_of_length.h"
#include "compiler/image/srgb.h"
#include "compiler/render/draw.h"
#include "compiler/render/radiance.h"

namespace orbc::driver {
namespace {

constexpr int kBakeSamplesPerPath = 32;

/// Paths of light between surfaces for each sample of a pixel.
int path_count(const scene::BakeSpec& spec) { return std::max(1, bake::bake_options(spec).radiosity.samples / kBakeSamplesPerPath); }

/// Where light is interpolated only where it is smooth, points at borders of shadows need not be denser than the pixels of the picture:
/// samples there are lit by themselves. In rooms that are larger than a unit of length, most is seen from farther away than that.
bake::BakeOptions cache_options(const PreparedScene& scene, const place::Camera& eye) {
  constexpr double kDensityPerPixel = 0.25;  // times pixels per radian, which is their density at distance 1
  bake::BakeOptions options = bake_options(scene, {});  // whatever the quality of exports
  const double distance = std::max({1.0, scene.interior().polygon.circumradius, scene.interior().height});
  options.min_density /= distance;
  options.max_density = std::clamp(kDensityPerPixel / distance * place::pixels_per_radian(eye), options.min_density, options.max_density);
  return options;
}

}  // namespace

render::DrawOptions draw_options(const PreparedScene& prepared, const place::Camera& eye, const Run& run) {
  const scene::Scene& scene = prepared.scene();
  const TraceContext& context = prepared.trace_context(run);
  const light::LightingContext& lighting = context.lighting;
  render::DrawOptions draw;
  draw.lighting = lighting.lit ? &lighting : nullptr;
  draw.paths = path_count(scene.bake);
  draw.max_bounces = scene.cover.max_bounces;
  draw.min_weight = scene.cover.min_weight;
  draw.background = scene.cover.background;
  // The film is exposed as a whole; the background is not.
  if (lighting.exposure > 0) {
    draw.background = (1 / lighting.exposure) * draw.background;
    draw.max_radiance = 1 / lighting.exposure;
  }
  if (scene.cover.background_expected && !draws_straight(scene))
    draw.background = cutoff::estimate_cutoff({scene, eye, context.tracer, &lighting}, {true, {}, {}}, run.executor).color;
  return draw;
}

namespace {

/// What the tracer draws with, and the light that it interpolates.
class FilmSetup {
 public:
  FilmSetup(const PreparedScene& scene, const place::Camera& eye, bool exact, const Run& run) : options_(draw_options(scene, eye, run)) {
    if (draws_straight(scene.scene())) {
      options_.straight = &straight_.emplace(scene.trace_context(run).tracer, eye, render::follow_options(options_));
      options_.max_depth = 0;  // what mirrors, glass and metals show belongs to an eye that sees along geodesics
      options_.highlights = false;
    }
    if (options_.lighting && !exact)
      options_.irradiance = &irradiance_.emplace(scene.interior(), *options_.lighting, cache_options(scene, eye));
  }
  FilmSetup(const FilmSetup&) = delete;
  FilmSetup& operator=(const FilmSetup&) = delete;
  render::DrawOptions& options() { return options_; }

 private:
  render::DrawOptions options_;  // refers to those below
  std::optional<render::StraightRays> straight_;
  std::optional<bake::IrradianceCache> irradiance_;
};

/// How far two colours are apart as they are shown, as a share of white's code.
double shown_difference(const scene::Color& a, const scene::Color& b, double exposure) {
  const auto apart = [&](double x, double y) { return std::fabs(image::encode_srgb(exposure * x) - image::encode_srgb(exposure * y)); };
  return std::max({apart(a.r, b.r), apart(a.g, b.g), apart(a.b, b.b)});
}

/// With four times the samples, on a grid, the error of an edge goes down to 4^(−3/4) of what it was (Mitchell, 1996, for stratified
/// sampling). So the error that is left is at most about 1/(4^(3/4) − 1) of what the pass has changed.
constexpr double kErrorOfChange = 0.55;

/// The error of each pixel that its last pass tells, as a share of white's code: what the pass has changed. Where chance remains its
/// standard error counts as well.
void take_changes(const render::Film& film, const render::Film& before, const std::vector<bool>& drawn, double exposure,
                  std::vector<double>& changes) {
  for (std::size_t i = 0; i < changes.size(); ++i) {
    if (!drawn[i]) continue;
    changes[i] = shown_difference(film.shown[i], before.shown[i], exposure);
    if (film.error.empty()) continue;
    const scene::Color& c = film.shown[i];
    const double e = film.error[i];
    changes[i] = std::max(changes[i], shown_difference(c, {c.r + e, c.g + e, c.b + e}, exposure));
  }
}

/// The pixels that are noisier than the target. Two passes may agree by chance, so a pixel is judged with its neighbours: by the root mean
/// square of the changes around it.
std::vector<bool> unsettled_pixels(const std::vector<double>& changes, int width, int height, double noise) {
  constexpr int kAround = 2;  // pixels in each direction
  std::vector<bool> unsettled(changes.size());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sum = 0;
      int count = 0;
      for (int v = std::max(0, y - kAround); v <= std::min(height - 1, y + kAround); ++v)
        for (int u = std::max(0, x - kAround); u <= std::min(width - 1, x + kAround); ++u, ++count) {
          const double change = changes[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)];
          sum += change * change;
        }
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      unsettled[i] = std::max(kErrorOfChange * changes[i], std::sqrt(sum / count)) > noise;
    }
  return unsettled;
}

double share_of(const std::vector<bool>& pixels) {
  return static_cast<double>(std::count(pixels.begin(), pixels.end(), true)) / static_cast<double>(pixels.size());
}

}  // namespace

render::Film trace_film(const PreparedScene& scene, const place::Camera& eye, const TraceOptions& options, const Executor& executor,
                        const Progress& progress) {
  const Run run{executor, progress};
  FilmSetup setup(scene, eye, options.exact, run);
  render::DrawOptions& draw = setup.options();
  draw.samples = options.samples;
  if (options.path_quality) {
    scene::BakeSpec spec = scene.scene().bake;
    spec.quality = *options.path_quality;
    draw.paths = path_count(spec);
  }
  return in_author_unit(render::draw(scene.trace_context(run).tracer, eye, draw, executor, progress), scene.loaded().unit_of_length);
}

render::Film trace_to_noise(const PreparedScene& scene, const place::Camera& eye, const NoiseTarget& target, const Executor& executor,
                            const std::function<void(const FilmPass&)>& after_pass, const Progress& progress) {
  const Run run{executor, progress};
  FilmSetup setup(scene, eye, target.exact, run);
  render::DrawOptions& draw = setup.options();
  const trace::TraceScene& tracer = scene.trace_context(run).tracer;
  const double exposure = scene.scene().exposure, unit = scene.loaded().unit_of_length;
  draw.samples = 1;
  render::Film film = render::draw(tracer, eye, draw, executor, progress);
  double mean_samples = 1;
  std::vector<bool> unsettled(film.color.size(), true);
  std::vector<double> changes(film.color.size());
  after_pass({in_author_unit(film, unit), 1, mean_samples, 1});
  for (draw.samples = 4; draw.samples <= target.max_samples; draw.samples *= 4) {
    const render::Film before = film;
    render::redraw(tracer, eye, draw, unsettled, film, executor, progress);
    mean_samples += draw.samples * share_of(unsettled);
    take_changes(film, before, unsettled, exposure, changes);
    unsettled = unsettled_pixels(changes, film.width, film.height, target.noise);
    const double share = share_of(unsettled);
    after_pass({in_author_unit(film, unit), draw.samples, mean_samples, share});
    if (share == 0) break;
  }
  return in_author_unit(std::move(film), unit);
}

render::Film trace_film(const LoadedScene& scene, const TraceOptions& options, const Executor& executor, const Progress& progress) {
  return trace_film(PreparedScene(scene), scene.eye, options, executor, progress);
}

}  // namespace orbc::driver
