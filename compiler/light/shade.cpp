// Light of a point: for every image of every lamp the straight geodesic to it, and, if it could matter, shadow rays (way.cpp). How many
// points of a lamp are asked follows from what the image could add: a step of its shadow stays below what 8 bits show.
#include "compiler/light/shade.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/light/falloff.h"
#include "compiler/light/guide.h"
#include "compiler/light/way.h"
#include "compiler/place/texel.h"
#include "compiler/surface/random.h"

namespace orbc::light {
namespace {

using geometry::Position;
using geometry::Space;
using scene::Color;
using trace::Direction;

constexpr int kMostProbes = 32;       // samples that decide whether there is a penumbra at all
constexpr double kStepsPerProbe = 4;  // of light that may pass between two of them
constexpr double kMostShared = 8;     // steps that one turn of several may be off, for each image
constexpr double kSmall = 0.25;       // extent of a lamp over its distance: the third order is 1.5 % of it, and less of the light

/// About how much an image could add at a point; 0 only where it surely adds nothing.
double expected(const LightField& field, const LampImage& image, const surface::LightPoint& point) {
  const Space space = field.scene.prism.space;
  const HungLamp& lamp = field.lamps[static_cast<std::size_t>(image.lamp)];
  const Way way = way_to(space, point.origin, image.samples[0], image.sheet);
  const double near = 2 * lamp.extent / std::max(way.length, 1e-9);
  const double cosine = way.exists ? trace::inner(space, way.start, point.normal) + near : 1;
  if (cosine <= 0 && near < 1) return 0;
  return largest(lamp.power) * image.weight * std::clamp(cosine, 0.05, 1.0) *
         falloff(lamp.falloff, space, std::max(way.length, lamp.radius), way.arc, lamp.radius);
}

/// The most that an image can add to a white surface so far away, white = 1.
double at_most(const LightField& field, const LampImage& image, double length, double arc) {
  return at_most(field.scene.prism.space, field.lamps[static_cast<std::size_t>(image.lamp)], image.weight, field.exposure, length, arc);
}

/// The next even number: beyond the design samples come in pairs about the lamp's middle.
int even(double count) { return 2 * static_cast<int>(std::ceil(std::min(count, 1e6) / 2)); }

/// What one turn asks of an image: `count` of the lamp's first `all` samples from `first` on, going round; for `weight` images.
struct Ask {
  int all = 1, first = 0, count = 0;
  double weight = 1;
};

/// In: how much the image could add, in steps; a number of its own, so that not all faint images have the same turn.
Ask ask_of(double steps, int samples, const Turn& turn, std::uint32_t image) {
  int all = 1;
  if (samples > 0 && steps > 1) all = std::clamp(even(steps), kDesign, samples);
  if (turn.of == 1) return {all, 0, all, 1};
  // Each turn may be off by more than their mean; how much more shows where several surfaces share the pixel.
  steps /= std::min(kMostShared, 2 * std::sqrt(turn.of));
  const int count = std::clamp(static_cast<int>(std::ceil(steps)), 1, all);
  if (steps >= 0.5) return {all, turn.rank * count, count, 1};
  // Faint: asked by every second, third, … turn, for a number that divides all turns.
  int every = 1;
  for (int m = 2; m <= turn.of && m * steps <= 1; ++m)
    if (turn.of % m == 0) every = m;
  if ((static_cast<std::uint64_t>(turn.rank) + surface::mixed(image)) % static_cast<std::uint64_t>(every) != 0) return {};
  return {all, turn.rank / every, 1, static_cast<double>(every)};
}

/// Adds up f(way, light) over the samples of an image, light = unhindered × weight; f(way) = 0 costs no ray.
template <class F>
Color gather(const LightField& field, std::uint32_t number, const surface::LightPoint& point, const Turn& turn, const F& f) {
  const LampImage& image = field.images[number];
  const Space space = field.scene.prism.space;
  const HungLamp& lamp = field.lamps[static_cast<std::size_t>(image.lamp)];
  const Way middle = way_to(space, point.origin, image.samples[0], image.sheet);
  double most = at_most(field, image, middle.length, middle.arc);
  if (most < field.options.cut) return {};
  if (middle.exists) {  // the lamp's own extent turns the direction to its samples by little
    const double cosine = trace::inner(space, middle.start, point.normal) + 2 * lamp.extent / middle.length;
    if (cosine <= 0 && middle.length > 2 * lamp.extent) return {};
    if (cosine < 1 && image.sheet == 0) most *= std::max(cosine, 0.0);
    if (most < field.options.cut) return {};
  }
  const Ask ask = ask_of(most / field.options.step, static_cast<int>(image.samples.size()) - 1, turn, number);
  if (ask.count == 0) return {};
  const auto sample = [&](int i) { return static_cast<std::size_t>(ask.all == 1 ? 0 : (ask.first + i) % ask.all + 1); };
  Color sum, seen, design;
  int asked = 0;
  bool same = true;
  // The design alone gives the light of the whole lamp to the third order in its size (lamp.cpp): enough where as many samples agree as its
  // brightness asks for, so that no border of a shadow passes between them. Turns have few samples each, and others than these.
  const bool small = turn.of == 1 && lamp.extent < kSmall * middle.length;
  const int probes = turn.of == 1 ? std::clamp(even(most / field.options.step / kStepsPerProbe), kDesign, kMostProbes) : ask.count;
  for (int i = 0; i < ask.count; ++i) {
    const Way way = way_to(space, point.origin, image.samples[sample(i)], image.sheet);
    const double share = way.exists ? f(way) : 0;
    const double light = share > 0 ? share * unhindered(field, image, lamp, sample(i), point, way) : 0;
    if (light > 0) {
      if (asked < probes || !same) {
        const Color weight = arriving(field, image, lamp, sample(i), point, way);
        same = same && (asked == 0 || weight == seen);
        seen = weight;
        ++asked;
      }
      sum = sum + light * seen;
    }
    if (i + 1 == kDesign) design = sum;
    if (i + 1 == probes && small && same && asked == probes) return (1.0 / kDesign) * (lamp.power * design);
  }
  return (ask.weight / ask.count) * (lamp.power * sum);
}

Color falling(const LightField& field, std::uint32_t image, const surface::LightPoint& point, const Turn& turn) {
  return gather(field, image, point, turn, [&](const Way& way) { return trace::inner(field.scene.prism.space, way.start, point.normal); });
}

}  // namespace

LightOptions light_options(const scene::Scene& scene) {
  LightOptions options;
  options.bounces = scene.bake.mirrors;
  if (scene.integrator == scene::Integrator::path) options.passes = scene.bake.bounces;
  options.leg_bounces = scene.cover.max_bounces;
  options.leg_min_weight = scene.cover.min_weight;
  options.background = (1 / std::max(scene.exposure, 1e-300)) * scene.cover.background;
  options.seed = static_cast<std::uint64_t>(scene.bake.seed);
  return options;
}

Result<LightField> prepare_light(const scene::Scene& scene, const place::PlacedRoom& room, const LightOptions& options,
                                 const Executor& executor) {
  LightField field;
  field.lit = !scene.lamps.empty() || options.passes > 0;
  field.exposure = scene.exposure;
  if (!field.lit) {
    field.ambient = {1, 1, 1};
    return field;
  }
  auto hung = hang_lamps(scene, room.room);
  if (!hung) return hung.error();
  field.ambient = scene.ambient;
  field.options = options;
  field.lamps = std::move(hung->lamps);
  for (HungLamp& lamp : field.lamps) lamp.feet = feet_of(lamp, room);
  auto images = lamp_images(field.lamps, room, {options.bounces, scene.exposure, options.cut});
  if (!images) return located(images.error(), scene.bake.mirrors_span);
  field.images = std::move(images).value();
  field.normals.resize(room.parts.size());
  executor(room.parts.size(), [&](std::size_t i) { field.normals[i] = surface::part_normals(room, room.parts[i]); });
  auto casting = std::make_shared<place::PlacedRoom>(room);
  if (!place::has_holes(room)) casting->textures.clear();
  casting->parts.erase(
      std::remove_if(casting->parts.begin(), casting->parts.end(), [](const place::PlacedMesh& part) { return lamp_of(part) >= 0; }),
      casting->parts.end());
  field.casting = casting;
  field.scene = trace::prepare(*field.casting, executor);
  field.near = near_images(field, executor);
  return field;
}

Color irradiance(const LightField& field, const surface::LightPoint& point, const Turn& turn) {
  Color sum;
  for (const std::uint32_t i : images_at(field, point.at)) sum = sum + falling(field, i, point, turn);
  return sum;
}

Color irradiance(const LightField& field, const surface::LightPoint& point, const std::vector<std::uint32_t>& images) {
  Color sum;
  for (const std::uint32_t i : images) sum = sum + falling(field, i, point, {});
  return sum;
}

std::vector<std::uint32_t> images_near(const LightField& field, const Position& centre, double radius, double share) {
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < field.images.size(); ++i) {
    const LampImage& image = field.images[i];
    const Way way = way_to(field.scene.prism.space, centre, image.samples[0], image.sheet);
    // On S² the focus makes falloff no function of distance alone that decreases.
    const bool decreases = field.scene.prism.space != Space::spherical;
    if (!decreases || at_most(field, image, way.length - radius, std::max(way.arc - radius, 0.0)) >= share * field.options.cut)
      near.push_back(i);
  }
  return near;
}

Color irradiance_guess(const LightField& field, const surface::LightPoint& point, const std::array<double, 3>& u) {
  const Space space = field.scene.prism.space;
  // An image is asked as often as it could give light, were nothing in between: one is kept of all that pass by, and one number serves
  // them all, since what decided stretches to a number that is even again (Chao 1982).
  double sum = 0, kept = 0, left = u[0];
  const LampImage* chosen = nullptr;
  for (const std::uint32_t i : images_at(field, point.at)) {
    const LampImage& image = field.images[i];
    const double could = expected(field, image, point);
    if (could <= 0) continue;
    sum += could;
    const double chance = could / sum;
    if (left < chance) chosen = &image, kept = could, left /= chance;
    else left = (left - chance) / (1 - chance);
  }
  if (!chosen) return {};
  const LampImage& image = *chosen;
  const HungLamp& lamp = field.lamps[static_cast<std::size_t>(image.lamp)];
  const std::size_t all = image.samples.size() - 1;
  const std::size_t sample = all == 0 ? 0 : 1 + std::min(all - 1, static_cast<std::size_t>(u[1] * static_cast<double>(all)));
  const Way way = way_to(space, point.origin, image.samples[sample], image.sheet);
  if (!way.exists) return {};
  const double cosine = trace::inner(space, way.start, point.normal);
  if (cosine <= 0) return {};
  const double light = cosine * unhindered(field, image, lamp, sample, point, way);
  if (light <= 0) return {};
  return (light * sum / kept) * (lamp.power * arriving(field, image, lamp, sample, point, way));
}

Color radiance_out(const LightField& field, const scene::Material& material, const Color& albedo, const Color& e) {
  Color out =
      material.kind == scene::MaterialKind::emissive ? material.emission * albedo : albedo * (field.ambient + (1 / std::numbers::pi) * e);
  const double white = white_of(field);
  return {std::min(out.r, white), std::min(out.g, white), std::min(out.b, white)};
}

double white_of(const LightField& field) { return 1 / std::max(field.exposure, 1e-300); }

surface::LightPoint light_point(const LightField& field, const place::PlacedRoom& room, const trace::SurfacePoint& point,
                                const trace::Hit& hit) {
  if (hit.target == trace::Target::triangle) {
    const auto part = static_cast<std::size_t>(hit.part);
    return surface::light_point(room, room.parts[part], field.normals[part], static_cast<std::size_t>(hit.triangle),
                                {hit.b[0], hit.b[1], hit.b[2]});
  }
  return {point.at, point.normal, point.at, point.wall, false};
}

}  // namespace orbc::light
