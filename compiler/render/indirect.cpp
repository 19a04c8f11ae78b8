// Path tracing with next-event estimation (Kajiya, The rendering equation, 1986) along geodesics. Because the product metric has an
// orthonormal frame at every point, everything local (cosines, solid angles, mirrors) is that of Euclidean space; the space shows only in
// where a direction leads, and in the falloff of lamps.
#include "compiler/render/indirect.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "compiler/image/srgb.h"
#include "compiler/light/connection.h"
#include "compiler/light/guide.h"
#include "compiler/light/light_path.h"
#include "compiler/surface/albedo.h"

namespace orbc::render {
namespace {

using scene::Color;

constexpr int kMinBounces = 2;  // no path is ended by Russian roulette before: these surfaces make most of the light

/// The beginning of a path: its first direction, and the numbers that choose the lamp sample at its first surface.
struct PathStart {
  light::DirectionSample direction;
  std::array<double, 3> lamp_numbers;
};

Color trace_indirect_path(const place::Interior& interior, const light::LightingContext& lighting, const surface::ShadingPoint& from,
                          const PathStart& start, surface::Random& random) {
  surface::ShadingPoint at = from;
  light::LightPath path;
  for (int bounces = 0; bounces < lighting.options.indirect_bounces; ++bounces) {
    if (bounces >= kMinBounces) {
      const double probability = std::min(1.0, max_channel(path.throughput));
      if (random.next() >= probability) break;
      path.throughput = (1 / probability) * path.throughput;
    }
    const light::DirectionSample sample =
        bounces == 0 ? start.direction : light::sample_direction(light::guide_at(lighting, at), random.next_three());
    if (sample.weight <= 0) break;
    path.throughput = sample.weight * path.throughput;
    path = light::extend_path(interior, lighting, path, light::spawn_ray(lighting, at, sample.direction), random);
    if (!path.end) break;
    at = light::shading_point(lighting, *lighting.shadow_casters, path.end->point, path.end->hit);
    path.throughput = path.throughput * surface::hit_albedo(interior, path.end->point);
    if (max_channel(path.throughput) <= 0) break;
    const Color direct = light::estimate_irradiance(lighting, at, bounces == 0 ? start.lamp_numbers : random.next_three());
    path.radiance = path.radiance + path.throughput * (lighting.ambient + (1 / std::numbers::pi) * direct);
  }
  return path.radiance;
}

}  // namespace

PixelSampler::PixelSampler(std::uint64_t seed, std::uint64_t pixel, int sample, int samples)
    : random(seed, pixel, static_cast<std::uint64_t>(sample)),
      lattice_index(sample / std::min(samples, kGroups)),
      stratum(stratum_of(sample, samples)) {
  surface::Random of_group(~seed, pixel, static_cast<std::uint64_t>(group_of(sample, samples)));
  for (double& v : shift) v = of_group.next();
}

light::SampleStratum PixelSampler::stratum_of(int sample, int samples) {
  const int side = static_cast<int>(std::lround(std::sqrt(samples)));
  if (side * side != samples) return {sample, samples};  // the samples are a lattice already
  const int i = sample % side, j = sample / side;
  int slope = std::max(1, static_cast<int>(std::lround(0.382 * side)));
  while (std::gcd(slope, side) != 1) ++slope;
  return {(i + slope * j) % side + side * j, samples};
}

Color indirect_irradiance(const place::Interior& interior, const light::LightingContext& lighting, const surface::ShadingPoint& from,
                          PixelSampler& sampler, int paths) {
  const light::Guide guide = light::guide_at(lighting, from);
  Color sum;
  for (int k = 0; k < paths; ++k) {
    const std::array<double, 6> u = surface::r6_point(sampler.lattice_index * paths + k, sampler.shift);
    const PathStart start{light::sample_direction(guide, {u[0], u[1], u[2]}), {u[3], u[4], u[5]}};
    sum = sum + trace_indirect_path(interior, lighting, from, start, sampler.random);
  }
  return (1.0 / paths) * sum;
}

double rms_noise(const Film& film, double exposure) {
  if (film.error.empty()) return 0;
  double sum = 0;
  for (std::size_t i = 0; i < film.error.size(); ++i) {
    const Color& c = film.color[i];
    const double value = exposure * max_channel(c), step = std::min(exposure * static_cast<double>(film.error[i]), 1.0);
    const double shown = 255 * (image::encode_srgb(value + step) - image::encode_srgb(std::max(0.0, value - step))) / 2;
    sum += shown * shown;
  }
  return std::sqrt(sum / static_cast<double>(film.error.size()));
}

}  // namespace orbc::render
