// Highlights: GGX lobes around the mirrored way to the eye. Most points of a surface lie in the lobe of no lamp, so a bound over the whole
// lamp comes first, and only what could show costs shadow rays. Each sample of a lamp stands for its patch of it, as large as its share:
// its lobe is widened by that (Karis, Real Shading in Unreal Engine 4, 2013, widens by the whole lamp), else polished metal would show the
// samples one by one.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/light/falloff.h"
#include "compiler/light/lobe.h"
#include "compiler/light/shade.h"
#include "compiler/light/way.h"

namespace orbc::light {
namespace {

using geometry::Space;
using scene::Color;
using trace::Direction;

constexpr double kFaint = 1.0 / 3000;  // of white: highlights that cannot reach it are left out
constexpr double kWeak = 1.0 / 400;    // of white: what cannot be brighter is asked once, from the middle of the lamp
constexpr int kProbes = 4;             // samples that decide whether the lamp is seen whole

/// A surface point under an eye: everything but the lamp.
struct Lobe {
  Space space;
  const LightPoint& point;
  const Direction& to_eye;
  Color face_on;
  double a2 = 0, nv = 0;

  /// Distribution of facets whose normal leans by the cosine nh, over 4 cos, and Smith's shadowing towards the eye; `wide` is added to α².
  [[nodiscard]] double towards_eye(double nh, double wide) const {
    const double w = a2 + wide;
    return facet_density(nh, w) * 0.5 / (nv + std::sqrt(w + (1 - w) * nv * nv));
  }

  /// Radiance to the eye for unit light across a way.
  [[nodiscard]] Color shine(const Direction& way, double wide) const {
    const double nl = trace::inner(space, point.normal, way);
    const Direction sum = way + to_eye;
    const double size = std::sqrt(trace::inner(space, sum, sum));
    if (nl <= 0 || size < 1e-9) return {};
    const Direction half = (1 / size) * sum;
    return (towards_eye(std::min(1.0, trace::inner(space, point.normal, half)), wide) * facets_seen(nl, a2 + wide)) *
           reflectance(face_on, trace::inner(space, way, half));
  }
  /// At most that for ways within the angle `turn` of this one.
  [[nodiscard]] double bound(const Direction& way, double turn, double wide) const {
    if (trace::inner(space, point.normal, way) + turn <= 0) return 0;
    const Direction sum = way + to_eye;
    const double size = std::sqrt(trace::inner(space, sum, sum));
    const double lh = size / 2, lean = turn / (2 * std::max(lh, 0.1));  // (l + v)/|l + v| turns by half as much as l, more at grazing light
    const double nh = size < 1e-9 ? 1 : std::min(1.0, trace::inner(space, point.normal, (1 / size) * sum));
    const double angle = std::max(0.0, std::acos(std::max(-1.0, nh)) - lean);
    return largest(reflectance(face_on, lh - turn)) * towards_eye(angle > 1.5 ? 0 : std::cos(angle), wide);
  }
};

/// What the facets reflect of one image of a lamp.
Color gathered(const LightField& field, const LampImage& image, const Lobe& lobe, const Turn& asked_by) {
  const HungLamp& lamp = field.lamps[static_cast<std::size_t>(image.lamp)];
  const double power = largest(lamp.power) * field.exposure;
  const Way middle = way_to(lobe.space, lobe.point.origin, image.samples[0], image.sheet);
  const auto all = static_cast<int>(image.samples.size()) - 1;
  const int count = std::max(1, all);
  int asks = std::max(1, count / asked_by.of);
  const double turn = middle.length > 1e-9 ? lamp.extent / middle.length : 4, patch = turn / 2;
  const double wide = all > 0 ? std::min(0.25, patch * patch * std::numbers::pi / count) : 0;
  bool whole = all == 0;  // its middle stands for all of it
  if (middle.exists && turn < 0.5) {
    const double light = power * image.weight * lamp.gain *
                         falloff(lamp.falloff, lobe.space, std::max(middle.length - lamp.extent, lamp.radius), middle.arc, lamp.radius);
    if (light < field.options.cut) return {};
    const double most = light * lobe.bound(middle.start, 1.1 * turn, wide);
    if (most < kFaint * std::min(4.0, std::sqrt(asked_by.of))) return {};
    whole = all == 0 || most < kWeak;
    if (whole) asks = 1;
  }
  Color sum, seen;
  int asked = 0;
  bool same = true;
  for (int i = 0; i < asks; ++i) {
    const auto sample = static_cast<std::size_t>(whole ? 0 : (asked_by.rank * asks + i) % all + 1);
    const Way way = way_to(lobe.space, lobe.point.origin, image.samples[sample], image.sheet);
    if (!way.exists) continue;
    const Color share = lobe.shine(way.start, wide);
    if (largest(share) <= 0) continue;
    const Color light = unhindered(field, image, lamp, sample, lobe.point, way) * share;
    if (power * largest(light) < kFaint / 2) continue;
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
  const double alpha = facet_width(material);
  const Lobe lobe{space, point, to_eye, face_on(material, albedo), alpha * alpha, trace::inner(space, point.normal, to_eye)};
  if (lobe.nv <= 0) return {};
  Color sum;
  for (const std::uint32_t i : images_at(field, point.at)) sum = sum + gathered(field, field.images[i], lobe, turn);
  return sum;
}

}  // namespace orbc::light
