// Highlights: GGX lobes around the mirrored way to the eye. Most points of a surface lie in the lobe of no lamp, so a bound over the whole
// lamp comes first, and only what could show costs shadow rays. Each sample of a lamp stands for its patch of it, as large as its share:
// its lobe is widened by that (Karis, Real Shading in Unreal Engine 4, 2013, widens by the whole lamp), else polished metal would show the
// samples one by one.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "compiler/base/elementary.h"
#include "compiler/light/falloff.h"
#include "compiler/light/shade.h"
#include "compiler/light/way.h"
#include "compiler/surface/lobe.h"

namespace orbc::light {
namespace {

using geometry::Space;
using scene::Color;
using trace::Direction;

constexpr double kFaint = 1.0 / 3000;  // of white: highlights that cannot reach it are left out
constexpr double kStep = 1.0 / 400;    // of white: what one shadow ray may decide
constexpr int kMost = 32;              // samples of a lamp
constexpr int kProbes = 4;             // samples that decide whether the lamp is seen whole

/// A surface point under an eye: everything but the lamp.
struct Lobe {
  Space space;
  const surface::LightPoint& point;
  const Direction& to_eye;
  Color face_on;
  double a2 = 0, nv = 0;

  /// Distribution of facets whose normal leans by the cosine nh, over 4 cos, and Smith's shadowing towards the eye; `wide` is added to α².
  [[nodiscard]] double towards_eye(double nh, double wide) const {
    const double w = a2 + wide;
    return surface::facet_density(nh, w) * 0.5 / (nv + std::sqrt(w + (1 - w) * nv * nv));
  }

  /// Radiance to the eye for unit light across a way.
  [[nodiscard]] Color shine(const Direction& way, double wide) const {
    const double nl = trace::inner(space, point.normal, way);
    const Direction sum = way + to_eye;
    const double size = std::sqrt(trace::inner(space, sum, sum));
    if (nl <= 0 || size < 1e-9) return {};
    const Direction half = (1 / size) * sum;
    return (towards_eye(std::min(1.0, trace::inner(space, point.normal, half)), wide) * surface::facets_seen(nl, a2 + wide)) *
           surface::reflectance(face_on, trace::inner(space, way, half));
  }
  /// At most that for ways within the angle `turn` of this one.
  [[nodiscard]] double bound(const Direction& way, double turn, double wide) const {
    if (trace::inner(space, point.normal, way) + turn <= 0) return 0;
    const Direction sum = way + to_eye;
    const double size = std::sqrt(trace::inner(space, sum, sum));
    const double lh = size / 2, lean = turn / (2 * std::max(lh, 0.1));  // (l + v)/|l + v| turns by half as much as l, more at grazing light
    const double nh = size < 1e-9 ? 1 : std::min(1.0, trace::inner(space, point.normal, (1 / size) * sum));
    const double angle = std::max(0.0, math::acos(std::max(-1.0, nh)) - lean);
    return largest(surface::reflectance(face_on, lh - turn)) * towards_eye(angle > 1.5 ? 0 : math::cos(angle), wide);
  }
};

/// What a point of a lamp would add, were nothing in between.
struct Part {
  Way way;
  std::size_t sample = 0;
  Color light;
};

/// How much of it arrives, by as many shadow rays as it is worth: steps of its shadow shall not show.
Color arriving_of(const LightField& field, const LampImage& image, const Lobe& lobe, const std::vector<Part>& parts, double power,
                  int count) {
  const HungLamp& lamp = field.lamps[static_cast<std::size_t>(image.lamp)];
  Color total;
  for (const Part& part : parts) total = total + part.light;
  const int all = static_cast<int>(parts.size()),
            rays = std::clamp(static_cast<int>(std::ceil(power * largest(total) / count / kStep)), 1, all);
  Color sum, seen;
  double asked_light = 0;
  bool same = true;
  for (int k = 0; k < rays; ++k) {
    const Part& part = parts[static_cast<std::size_t>((2 * k + 1) * all / (2 * rays))];
    if (k < kProbes || !same) {
      const Color weight = arriving(field, image, lamp, part.sample, lobe.point, part.way);
      same = same && (k == 0 || weight == seen);
      seen = weight;
    }
    sum = sum + largest(part.light) * seen;
    asked_light += largest(part.light);
  }
  return (1 / asked_light) * (total * sum);
}

/// What the facets reflect of one image of a lamp.
Color gathered(const LightField& field, const LampImage& image, const Lobe& lobe) {
  const HungLamp& lamp = field.lamps[static_cast<std::size_t>(image.lamp)];
  const double power = largest(lamp.power) * field.exposure;
  const Way middle = way_to(lobe.space, lobe.point.origin, image.samples[0], image.sheet);
  const double turn = middle.length > 1e-9 ? lamp.extent / middle.length : 4, patch = turn / 2;
  int count = std::clamp(static_cast<int>(image.samples.size()) - 1, 1, kMost);
  const auto wide = [&](int patches) { return lamp.extent > 0 ? std::min(0.25, patch * patch * std::numbers::pi / patches) : 0; };
  if (middle.exists && turn < 0.5) {
    const double light = power * image.weight * lamp.gain *
                         falloff(lamp.falloff, lobe.space, std::max(middle.length - lamp.extent, lamp.radius), middle.arc, lamp.radius);
    if (light < field.options.cut) return {};
    const double most = light * lobe.bound(middle.start, 1.1 * turn, wide(count));
    if (most < kFaint) return {};
    if (most < kStep) count = 1;  // the lamp's middle stands for all of it
  }
  std::vector<Part> parts;
  parts.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const auto sample = static_cast<std::size_t>(count > 1 ? i + 1 : 0);
    const Way way = way_to(lobe.space, lobe.point.origin, image.samples[sample], image.sheet);
    if (!way.exists) continue;
    const Color share = lobe.shine(way.start, wide(count));
    if (largest(share) <= 0) continue;
    const Color light = unhindered(field, image, lamp, sample, lobe.point, way) * share;
    if (power * largest(light) >= kFaint / 2) parts.push_back({way, sample, light});
  }
  if (parts.empty()) return {};
  return (1.0 / count) * (lamp.power * arriving_of(field, image, lobe, parts, power, count));
}

}  // namespace

Color highlight(const LightField& field, const surface::LightPoint& point, const Direction& to_eye, const scene::Material& material,
                const Color& albedo) {
  const Space space = field.scene.prism.space;
  const double alpha = surface::facet_width(material);
  const Lobe lobe{space, point, to_eye, surface::face_on(material, albedo), alpha * alpha, trace::inner(space, point.normal, to_eye)};
  if (lobe.nv <= 0) return {};
  Color sum;
  for (const std::uint32_t i : images_at(field, point.at)) sum = sum + gathered(field, field.images[i], lobe);
  return material.kind == scene::MaterialKind::metal ? surface::by_several_facets(lobe.face_on, lobe.nv, alpha) * sum : sum;
}

}  // namespace orbc::light
