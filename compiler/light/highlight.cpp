// Highlights: GGX lobes around the mirrored way to the eye. Most points of a surface lie in the lobe of no lamp, so a bound over the whole
// lamp comes first, and only what could show costs shadow rays. Each sample of a lamp stands for its patch of it, as large as its share:
// its lobe is widened by that (Karis, Real Shading in Unreal Engine 4, 2013, widens by the whole lamp), else polished metal would show the
// samples one by one.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/light/falloff.h"
#include "compiler/light/shade.h"
#include "compiler/light/way.h"

namespace orbc::light {
namespace {

using geometry::Space;
using scene::Color;
using trace::Direction;

constexpr double kFaint = 1.0 / 3000;  // of white: highlights that cannot reach it are left out
constexpr int kProbes = 4;             // samples that decide whether the lamp is seen whole

/// A surface point under an eye: everything but the lamp.
struct Lobe {
  Space space;
  const LightPoint& point;
  const Direction& to_eye;
  double a2 = 0, f0 = 1, nv = 0;

  [[nodiscard]] double fresnel(double lh) const {
    const double t = 1 - std::clamp(lh, 0.0, 1.0), t2 = t * t;
    return f0 + (1 - f0) * t2 * t2 * t;
  }
  /// Distribution of facets whose normal leans by the cosine nh; `wide` is added to α².
  [[nodiscard]] double facets(double nh, double wide) const {
    const double w = a2 + wide, base = nh * nh * (w - 1) + 1;
    return w / (std::numbers::pi * base * base);
  }
  [[nodiscard]] double smith(double c, double wide) const { return 2 * c / (c + std::sqrt(a2 + wide + (1 - a2 - wide) * c * c)); }
  /// Smith's shadowing towards the eye, over 4 cos.
  [[nodiscard]] double towards_eye(double wide) const { return 0.5 / (nv + std::sqrt(a2 + wide + (1 - a2 - wide) * nv * nv)); }

  /// Radiance to the eye for unit light across a way.
  [[nodiscard]] double shine(const Direction& way, double wide) const {
    const double nl = trace::inner(space, point.normal, way);
    const Direction sum = way + to_eye;
    const double size = std::sqrt(trace::inner(space, sum, sum));
    if (nl <= 0 || size < 1e-9) return 0;
    const Direction half = (1 / size) * sum;
    return fresnel(trace::inner(space, way, half)) * facets(std::min(1.0, trace::inner(space, point.normal, half)), wide) *
           smith(nl, wide) * towards_eye(wide);
  }
  /// At most that for ways within the angle `turn` of this one.
  [[nodiscard]] double bound(const Direction& way, double turn, double wide) const {
    if (trace::inner(space, point.normal, way) + turn <= 0) return 0;
    const Direction sum = way + to_eye;
    const double size = std::sqrt(trace::inner(space, sum, sum));
    const double lh = size / 2, lean = turn / (2 * std::max(lh, 0.1));  // (l + v)/|l + v| turns by half as much as l, more at grazing light
    const double nh = size < 1e-9 ? 1 : std::min(1.0, trace::inner(space, point.normal, (1 / size) * sum));
    const double angle = std::max(0.0, std::acos(std::max(-1.0, nh)) - lean);
    return fresnel(lh - turn) * facets(angle > 1.5 ? 0 : std::cos(angle), wide) * towards_eye(wide);
  }
};

/// What the facets reflect of one image of a lamp.
Color gathered(const LightField& field, const LampImage& image, const Lobe& lobe, const Turn& asked_by) {
  const HungLamp& lamp = field.lamps[static_cast<std::size_t>(image.lamp)];
  const double power = largest(lamp.power) * field.exposure;
  const Way middle = way_to(lobe.space, lobe.point.origin, image.samples[0], image.sheet);
  const auto all = static_cast<int>(image.samples.size()) - 1;
  const int count = std::max(1, all), asks = std::max(std::min(count, kProbes), count / asked_by.of);
  const double turn = middle.length > 1e-9 ? lamp.extent / middle.length : 4, patch = turn / 2;
  const double wide = all > 0 ? std::min(0.25, patch * patch * std::numbers::pi / count) : 0;
  if (middle.exists && turn < 0.5) {
    const double light = power * image.weight * lamp.gain *
                         falloff(lamp.falloff, lobe.space, std::max(middle.length - lamp.extent, lamp.radius), middle.arc, lamp.radius);
    if (light < field.options.cut || light * lobe.bound(middle.start, 1.1 * turn, wide) < kFaint) return {};
  }
  Color sum, seen;
  int asked = 0;
  bool same = true;
  for (int i = 0; i < asks; ++i) {
    const auto sample = static_cast<std::size_t>(all > 0 ? (asked_by.rank * asks + i) % all + 1 : 0);
    const Way way = way_to(lobe.space, lobe.point.origin, image.samples[sample], image.sheet);
    if (!way.exists) continue;
    const double share = lobe.shine(way.start, wide);
    if (share <= 0) continue;
    const double light = share * unhindered(field, image, lamp, sample, lobe.point, way);
    if (power * light < kFaint / 2) continue;
    if (asked < kProbes || !same) {
      const Color weight = arriving(field, image, lamp, sample, lobe.point, way);
      same = same && (asked == 0 || weight == seen);
      seen = weight;
      ++asked;
    }
    sum = sum + light * seen;
  }
  return (1.0 / asks) * (lamp.power * sum);
}

}  // namespace

Color highlight(const LightField& field, const LightPoint& point, const Direction& to_eye, const scene::Material& material,
                const Color& albedo, const Turn& turn) {
  const Space space = field.scene.prism.space;
  const double alpha = std::max(material.roughness * material.roughness, 0.002);
  const bool metal = material.kind == scene::MaterialKind::metal;
  const double f0 = metal ? 1 : std::pow((material.index - 1) / (material.index + 1), 2);
  const Lobe lobe{space, point, to_eye, alpha * alpha, f0, trace::inner(space, point.normal, to_eye)};
  if (lobe.nv <= 0) return {};
  Color sum;
  for (const std::uint32_t i : images_at(field, point.at)) sum = sum + gathered(field, field.images[i], lobe, turn);
  return metal ? albedo * sum : sum;
}

}  // namespace orbc::light
