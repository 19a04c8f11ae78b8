#include "compiler/render/draw.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "compiler/render/shade.h"

namespace orbc::render {
namespace {

constexpr int kTile = 16;  // pixels; small enough to spread over threads, large enough that neighbours share the tree in cache

void draw_pixel(const trace::TraceScene& scene, const place::Eye& eye, const DrawOptions& options, const std::vector<std::array<double, 2>>& samples, int x, int y, Film& film) {
  const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(film.width) + static_cast<std::size_t>(x);
  scene::Color sum;
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const Seen seen = radiance(scene, eye_ray(eye, x + samples[s][0], y + samples[s][1]), options);
    sum = sum + seen.radiance;
    if (s > 0) continue;
    film.bounces[pixel] = seen.path.bounces;
    film.weight[pixel] = static_cast<float>(std::max({seen.path.weight.r, seen.path.weight.g, seen.path.weight.b}));
    if (!seen.hit) continue;
    film.depth[pixel] = static_cast<float>(seen.path.length);
    film.object[pixel] = seen.surface.part;
    film.normal[pixel] = {static_cast<float>(seen.surface.normal.floor.x), static_cast<float>(seen.surface.normal.floor.y), static_cast<float>(seen.surface.normal.z)};
  }
  film.color[pixel] = (1.0 / static_cast<double>(samples.size())) * sum;
}

}  // namespace

trace::Ray eye_ray(const place::Eye& eye, double x, double y) {
  const geometry::Vector3 d = place::direction_through(eye, x, y);
  const geometry::Point at = eye.room_from_eye * geometry::Point();
  const geometry::Tangent floor = eye.room_from_eye * geometry::Tangent(0, d.x, d.y);
  return trace::ray_from(eye.room_from_eye.space, {at, eye.z}, {floor, d.z});
}

std::vector<std::array<double, 2>> sample_points(int samples) {
  const int side = static_cast<int>(std::lround(std::sqrt(samples)));
  std::vector<std::array<double, 2>> points;
  if (side * side == samples) {
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) points.push_back({(i + 0.5) / side, (j + 0.5) / side});
    return points;
  }
  // Kronecker lattice of the golden ratio: one coordinate stratified, the other with the least discrepancy (Niederreiter 1992, §3).
  for (int i = 0; i < samples; ++i) points.push_back({(i + 0.5) / samples, std::fmod(0.5 + i * 0.6180339887498949, 1.0)});
  return points;
}

Film draw(const trace::TraceScene& scene, const place::Eye& eye, const DrawOptions& options, const Executor& executor, const Progress& progress) {
  Film film = make_film(eye.width, eye.height);
  const std::vector<std::array<double, 2>> samples = sample_points(options.samples);
  const int columns = (eye.width + kTile - 1) / kTile, rows = (eye.height + kTile - 1) / kTile;
  const std::uint64_t total = static_cast<std::uint64_t>(eye.width) * static_cast<std::uint64_t>(eye.height) * samples.size();
  std::atomic<std::uint64_t> done{0};
  executor(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), [&](std::size_t tile) {
    const int x0 = static_cast<int>(tile % static_cast<std::size_t>(columns)) * kTile, y0 = static_cast<int>(tile / static_cast<std::size_t>(columns)) * kTile;
    const int x1 = std::min(x0 + kTile, eye.width), y1 = std::min(y0 + kTile, eye.height);
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) draw_pixel(scene, eye, options, samples, x, y, film);
    const std::uint64_t rays = static_cast<std::uint64_t>(x1 - x0) * static_cast<std::uint64_t>(y1 - y0) * samples.size();
    report(progress, "tracing", done.fetch_add(rays) + rays, total, "rays");
  });
  return film;
}

}  // namespace orbc::render
