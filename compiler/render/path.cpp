// Path tracing with next-event estimation (Kajiya, The rendering equation, 1986) along geodesics. Because the product metric has an
// orthonormal frame at every point, everything local (cosines, solid angles, mirrors) is that of Euclidean space; the space shows only in
// where a direction leads, and in the falloff of lamps.
#include "compiler/render/path.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "compiler/image/srgb.h"
#include "compiler/light/guide.h"
#include "compiler/light/leg.h"
#include "compiler/light/way.h"

namespace orbc::render {
namespace {

using scene::Color;

constexpr int kSurePasses = 2;  // surfaces before which no path is ended by chance: they make most of the light

// One path, by the direction in which it begins and the numbers that choose what lights its first surface.
Color walked(const place::PlacedRoom& room, const light::LightField& field, const surface::LightPoint& from, const light::Chosen& first,
             const std::array<double, 3>& first_light, surface::Random& random) {
  surface::LightPoint at = from;
  light::Leg leg{room, field, random, {}, {1, 1, 1}, {}, {}};
  for (int passes = 0; passes < field.options.passes; ++passes) {
    if (passes >= kSurePasses) {  // whether the path goes on: by a chance that its weight makes up for
      const double chance = std::min(1.0, largest(leg.weight));
      if (random.next() >= chance) break;
      leg.weight = (1 / chance) * leg.weight;
    }
    const light::Chosen chosen = passes == 0 ? first : light::choose(light::guide_at(field, at), random.next_three());
    if (chosen.weight <= 0) break;
    leg.weight = chosen.weight * leg.weight;
    if (!leg.arrive(light::leaving(field, at, chosen.direction))) break;
    at = light::light_point(field, *field.casting, leg.point, leg.hit);
    leg.weight = leg.weight * surface::surface_color(room, leg.point);
    if (largest(leg.weight) <= 0) break;
    const Color light = light::irradiance_guess(field, at, passes == 0 ? first_light : random.next_three());
    leg.sum = leg.sum + leg.weight * (field.ambient + (1 / std::numbers::pi) * light);
  }
  return leg.sum;
}

}  // namespace

Chance::Chance(std::uint64_t seed, std::uint64_t pixel, int sample, int samples)
    : random(seed, pixel, static_cast<std::uint64_t>(sample)), before(sample / std::min(samples, kGroups)), turn(turn_of(sample, samples)) {
  surface::Random of_group(~seed, pixel, static_cast<std::uint64_t>(group_of(sample, samples)));
  for (double& v : shift) v = of_group.next();
}

light::Turn Chance::turn_of(int sample, int samples) {
  const int side = static_cast<int>(std::lround(std::sqrt(samples)));
  if (side * side != samples) return {sample, samples};  // a lattice already
  const int i = sample % side, j = sample / side;
  int slope = std::max(1, static_cast<int>(std::lround(0.382 * side)));
  while (std::gcd(slope, side) != 1) ++slope;
  return {(i + slope * j) % side + side * j, samples};
}

Color passed_on(const place::PlacedRoom& room, const light::LightField& field, const surface::LightPoint& from, Chance& chance, int paths) {
  const light::Guide guide = light::guide_at(field, from);
  Color sum;
  for (int k = 0; k < paths; ++k) {
    const std::array<double, 6> u = surface::r6_point(chance.before * paths + k, chance.shift);
    sum = sum + walked(room, field, from, light::choose(guide, {u[0], u[1], u[2]}), {u[3], u[4], u[5]}, chance.random);
  }
  return (1.0 / paths) * sum;
}

double noise_of(const Film& film, double exposure) {
  if (film.error.empty()) return 0;
  double sum = 0;
  for (std::size_t i = 0; i < film.error.size(); ++i) {
    const Color& c = film.color[i];
    const double value = exposure * largest(c), step = std::min(exposure * static_cast<double>(film.error[i]), 1.0);
    const double shown = 255 * (image::encode_srgb(value + step) - image::encode_srgb(std::max(0.0, value - step))) / 2;
    sum += shown * shown;
  }
  return std::sqrt(sum / static_cast<double>(film.error.size()));
}

}  // namespace orbc::render
