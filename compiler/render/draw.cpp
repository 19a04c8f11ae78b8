#include "compiler/render/draw.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "compiler/render/lens.h"
#include "compiler/render/radiance.h"

namespace orbc::render {
namespace {

constexpr int kTileSide = 16;                // pixels: many tiles for the threads, and neighbours share the tree in the cache
constexpr std::size_t kRaysPerStream = 512;  // their paths fit into the second-level cache

struct Pixel {
  int x = 0, y = 0;
};

// Writes what the first sample of a pixel has found into the passes of the film.
void record(const RayResult& result, std::size_t pixel, Film& film) {
  film.bounces[pixel] = result.path.bounces;
  film.weight[pixel] = static_cast<float>(std::max({result.path.throughput.r, result.path.throughput.g, result.path.throughput.b}));
  if (!result.hit) return;
  film.depth[pixel] = static_cast<float>(result.path.length);
  film.object[pixel] = result.surface.part;
  film.normal[pixel] = {static_cast<float>(result.surface.normal.floor.x), static_cast<float>(result.surface.normal.floor.y),
                        static_cast<float>(result.surface.normal.z)};
}

/// Sums over a pixel's samples, in their order.
struct PixelSums {
  scene::Color radiance;
  ShownRadiance shown;
  struct Group {
    scene::Color indirect;
    int count = 0;
  };
  std::array<Group, PixelSampler::kGroups> groups;  ///< of samples that share a lattice
  /// In: the radiance that shows as white.
  void add(const RayResult& result, double white, int group) {
    radiance = radiance + result.radiance;
    const ShownRadiance own_shown = shown_radiance(result, white);
    shown = {shown.radiance + own_shown.radiance, shown.bound + own_shown.bound};
    Group& own = groups[static_cast<std::size_t>(group)];
    own.indirect = own.indirect + result.indirect;
    ++own.count;
  }
  [[nodiscard]] scene::Color mean(double n) const { return (1 / n) * radiance; }
  [[nodiscard]] scene::Color shown_mean(double n) const { return component_min((1 / n) * shown.radiance, (1 / n) * shown.bound); }
  /// Standard error of the mean in the noisiest channel, from the spread between groups; of a single sample its estimate itself.
  [[nodiscard]] float error(double n) const {
    scene::Color indirect, squares;
    for (const Group& group : groups) indirect = indirect + group.indirect;
    if (n < 2) return static_cast<float>(max_channel(indirect));
    double count = 0;
    for (const Group& group : groups) {
      if (group.count == 0) continue;
      const scene::Color off = (1.0 / group.count) * group.indirect + (-1.0 / n) * indirect;
      squares = squares + off * off;
      ++count;
    }
    // A channel that is cut off at white shows no noise.
    const auto variance = [&](double sum, double all, double bound) { return all >= bound ? 0 : sum / (count * (count - 1)); };
    return static_cast<float>(std::sqrt(
        scene::max_channel({variance(squares.r, shown.radiance.r, shown.bound.r), variance(squares.g, shown.radiance.g, shown.bound.g),
                            variance(squares.b, shown.radiance.b, shown.bound.b)})));
  }
};

/// The ray of one of two eyes: its place beside the camera's, its direction transported in parallel along the geodesic there.
trace::Ray stereo_ray(const place::Camera& eye, double x, double y) {
  const geometry::Space space = eye.room_from_eye.space;
  const geometry::Vector3 d = place::direction_through(eye, x, y), offset = place::eye_offset(eye, x, y);
  const geometry::Isometry room_from_this_eye = eye.room_from_eye * geometry::translation_by(space, offset.x, offset.y);
  return trace::ray_from(space, {room_from_this_eye * geometry::Point(), eye.z},
                         {room_from_this_eye * geometry::Tangent(0, d.x, d.y), d.z});
}

// In: the eye's point of the floor.
trace::Ray eye_ray_from(const place::Camera& eye, const geometry::Point& at, double x, double y) {
  if (eye.projection == scene::Projection::stereo) return stereo_ray(eye, x, y);
  const geometry::Vector3 d = place::direction_through(eye, x, y);
  const geometry::Tangent floor = eye.room_from_eye * geometry::Tangent(0, d.x, d.y);
  return trace::ray_from(eye.room_from_eye.space, {at, eye.z}, {floor, d.z});
}

std::uint64_t seed_of(const DrawOptions& options) {
  return options.lighting ? static_cast<std::uint64_t>(options.lighting->options.seed) : 0;
}

std::size_t index_of(const Pixel& at, const Film& film) {
  return static_cast<std::size_t>(at.y) * static_cast<std::size_t>(film.width) + static_cast<std::size_t>(at.x);
}

PixelSampler sampler_for(const DrawOptions& options, std::size_t pixel, int sample) {
  return {seed_of(options), pixel, sample, options.samples};
}

/// Draws pixels with all their samples, a stream of rays at a time.
void draw_pixels(const trace::TraceScene& scene, const place::Camera& eye, const DrawOptions& options,
                 const std::vector<std::array<double, 2>>& samples, const std::vector<Pixel>& pixels, Film& film) {
  const std::size_t count = samples.size(), all = pixels.size() * count;
  const double n = static_cast<double>(count), white = options.lighting ? light::white_level(*options.lighting) : options.max_radiance;
  const geometry::Point eye_at = eye.room_from_eye * geometry::Point();
  std::vector<trace::Ray> rays;
  rays.reserve(std::min(all, kRaysPerStream));
  PixelSums sums;
  for (std::size_t first = 0; first < all; first += kRaysPerStream) {
    rays.clear();
    for (std::size_t i = first; i < std::min(all, first + kRaysPerStream); ++i) {
      const double x = pixels[i / count].x + samples[i % count][0], y = pixels[i / count].y + samples[i % count][1];
      if (eye.lens) {
        const auto on_lens = lens_point(seed_of(options), index_of(pixels[i / count], film), static_cast<int>(i % count));
        rays.push_back(lens_ray(eye, x, y, on_lens));
      } else {
        rays.push_back(eye_ray_from(eye, eye_at, x, y));
      }
    }
    std::vector<trace::Path> paths;
    if (!options.straight) paths = trace::follow(scene, rays, follow_options(options));
    else
      for (const trace::Ray& ray : rays) paths.push_back(options.straight->follow(ray));
    for (std::size_t j = 0; j < paths.size(); ++j) {
      const std::size_t i = first + j, sample = i % count;
      const Pixel at = pixels[i / count];
      const std::size_t pixel = index_of(at, film);
      const RayResult result = radiance(scene, std::move(paths[j]), options, sampler_for(options, pixel, static_cast<int>(sample)));
      if (sample == 0) {
        sums = {};
        record(result, pixel, film);
      }
      sums.add(result, white, PixelSampler::group_of(static_cast<int>(sample), static_cast<int>(count)));
      if (sample + 1 < count) continue;
      film.color[pixel] = sums.mean(n);
      film.shown[pixel] = sums.shown_mean(n);
      if (!film.error.empty()) film.error[pixel] = sums.error(n);
    }
  }
}

/// The tile to be drawn as the k-th of `count`. They come from all over the picture, so that what was drawn so far tells how long the rest
/// will take. In: k < count.
std::size_t scattered_tile(std::size_t k, std::size_t count) {
  auto stride = static_cast<std::size_t>(0.6180339887498949 * static_cast<double>(count)) + 1;
  while (std::gcd(stride, count) != 1) ++stride;
  return k * stride % count;
}

}  // namespace

trace::Ray eye_ray(const place::Camera& eye, double x, double y) { return eye_ray_from(eye, eye.room_from_eye * geometry::Point(), x, y); }

std::vector<std::array<double, 2>> sample_points(int samples) {
  const int side = static_cast<int>(std::lround(std::sqrt(samples)));
  std::vector<std::array<double, 2>> points;
  if (side * side == samples) {
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) points.push_back({(i + 0.5) / side, (j + 0.5) / side});
    return points;
  }
  // The lattice of the golden ratio: one coordinate is stratified, the other has low discrepancy (Niederreiter 1992, §3).
  for (int i = 0; i < samples; ++i) points.push_back({(i + 0.5) / samples, std::fmod(0.5 + i * 0.6180339887498949, 1.0)});
  return points;
}

void redraw(const trace::TraceScene& scene, const place::Camera& eye, const DrawOptions& options, const std::vector<bool>& wanted,
            Film& film, const Executor& executor, const Progress& progress) {
  const std::vector<std::array<double, 2>> samples = sample_points(options.samples);
  film.shown.resize(film.color.size());
  const int columns = (eye.width + kTileSide - 1) / kTileSide, rows = (eye.height + kTileSide - 1) / kTileSide;
  const std::uint64_t total = static_cast<std::uint64_t>(std::count(wanted.begin(), wanted.end(), true)) * samples.size();
  std::atomic<std::uint64_t> done{0};
  const std::size_t tiles = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  executor(tiles, [&](std::size_t k) {
    const std::size_t tile = scattered_tile(k, tiles);
    const int x0 = static_cast<int>(tile % static_cast<std::size_t>(columns)) * kTileSide,
              y0 = static_cast<int>(tile / static_cast<std::size_t>(columns)) * kTileSide;
    const int x1 = std::min(x0 + kTileSide, eye.width), y1 = std::min(y0 + kTileSide, eye.height);
    std::vector<Pixel> pixels;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x)
        if (wanted[index_of({x, y}, film)]) pixels.push_back({x, y});
    draw_pixels(scene, eye, options, samples, pixels, film);
    const std::uint64_t rays = pixels.size() * samples.size();
    report(progress, "tracing", done.fetch_add(rays) + rays, total, "rays");
  });
}

Film draw(const trace::TraceScene& scene, const place::Camera& eye, const DrawOptions& options, const Executor& executor,
          const Progress& progress) {
  Film film = make_film(eye.width, eye.height);
  if (options.lighting && options.lighting->options.indirect_bounces > 0) film.error.assign(film.color.size(), 0);
  redraw(scene, eye, options, std::vector<bool>(film.color.size(), true), film, executor, progress);
  return film;
}

}  // namespace orbc::render
