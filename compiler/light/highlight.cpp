// Highlights: GGX lobes around the direction of perfect reflection to the eye. Most surface points lie in the lobe of no lamp, so an upper
// bound for the whole lamp comes first, and shadow rays are traced only for what can be visible. A sample stands for its share of the
// lamp's area: its lobe is widened by the solid angle of that share, or else smooth metals would show the samples one by one (Karis, Real
// shading in Unreal Engine 4, 2013, widens by the whole lamp).
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "compiler/base/elementary.h"
#include "compiler/light/connection.h"
#include "compiler/light/falloff.h"
#include "compiler/light/lighting.h"
#include "compiler/surface/ggx.h"

namespace orbc::light {
namespace {

using geometry::Space;
using scene::Color;
using trace::Direction;

constexpr double kMinHighlight = 1.0 / 3000;  // of white: highlights that stay below are left out
constexpr double kMaxShadowStep = 1.0 / 400;  // of white: the most that one shadow ray decides
constexpr int kMaxLampSamples = 32;
constexpr int kVisibilityProbes = 4;  // shadow rays that decide whether the whole lamp is visible

/// A surface point and the direction to the eye: the specular BRDF but for the direction to the light.
struct SpecularLobe {
  Space space;
  const surface::ShadingPoint& point;
  const Direction& to_eye;
  Color f0;
  double a2 = 0;       ///< α²
  double cos_eye = 0;  ///< > 0
  double share = 1;    ///< of a pixel

  /// D·G₁(eye)/(4·cos_eye), for the cosine of the half vector to the normal. `widening` is added to α².
  [[nodiscard]] double d_times_g1(double cos_half, double widening) const {
    const double w = a2 + widening;
    return surface::ggx_d(cos_half, w) * 0.5 / (cos_eye + std::sqrt(w + (1 - w) * cos_eye * cos_eye));
  }

  /// BRDF × cosine for light from the direction `to_light`.
  [[nodiscard]] Color reflected(const Direction& to_light, double widening) const {
    const double cos_light = trace::inner(space, point.normal, to_light);
    const Direction sum = to_light + to_eye;
    const double size = std::sqrt(trace::inner(space, sum, sum));
    if (cos_light <= 0 || size < 1e-9) return {};
    const Direction half = (1 / size) * sum;
    return (d_times_g1(std::min(1.0, trace::inner(space, point.normal, half)), widening) * surface::smith_g1(cos_light, a2 + widening)) *
           surface::fresnel_schlick(f0, trace::inner(space, to_light, half));
  }
  /// Upper bound of `reflected` for directions within the angle `spread` of `to_light`.
  [[nodiscard]] double bound(const Direction& to_light, double spread, double widening) const {
    if (trace::inner(space, point.normal, to_light) + spread <= 0) return 0;
    const Direction sum = to_light + to_eye;
    const double size = std::sqrt(trace::inner(space, sum, sum));
    // The half vector turns by half the angle by which the light does, and by more at grazing angles.
    const double cos_light_half = size / 2, half_spread = spread / (2 * std::max(cos_light_half, 0.1));
    const double cos_half = size < 1e-9 ? 1 : std::min(1.0, trace::inner(space, point.normal, (1 / size) * sum));
    const double angle = std::max(0.0, math::acos(std::max(-1.0, cos_half)) - half_spread);
    return max_channel(surface::fresnel_schlick(f0, cos_light_half - spread)) * d_times_g1(angle > 1.5 ? 0 : math::cos(angle), widening);
  }
};

/// A sample of a lamp and the radiance it adds if nothing blocks it.
struct LampSample {
  Connection connection;
  std::size_t sample = 0;
  Color unoccluded;  ///< per unit of the lamp's power
};

/// The sum of the samples with shadows. The number of shadow rays follows from the brightness, so that steps of shadows stay invisible.
/// In: the samples' sum × power / count is the highlight, white = 1.
Color visible_highlight(const LightingContext& lighting, const LampImage& image, const SpecularLobe& lobe,
                        const std::vector<LampSample>& samples, double power, int count) {
  Color total;
  for (const LampSample& sample : samples) total = total + sample.unoccluded;
  const int all = static_cast<int>(samples.size()),
            rays = std::clamp(static_cast<int>(std::ceil(lobe.share * power * max_channel(total) / count / kMaxShadowStep)), 1, all);
  Color sum, throughput;
  double weights = 0;
  bool agree = true;
  for (int k = 0; k < rays; ++k) {
    const LampSample& sample = samples[static_cast<std::size_t>((2 * k + 1) * all / (2 * rays))];
    if (k < kVisibilityProbes || !agree) {
      const Color arriving = shadow_transmittance(lighting, image, sample.sample, lobe.point, sample.connection);
      agree = agree && (k == 0 || arriving == throughput);
      throughput = arriving;
    }
    sum = sum + max_channel(sample.unoccluded) * throughput;
    weights += max_channel(sample.unoccluded);
  }
  return (1 / weights) * (total * sum);
}

/// The highlight of one image of a lamp.
Color image_highlight(const LightingContext& lighting, const LampImage& image, const SpecularLobe& lobe) {
  const PlacedLamp& lamp = lamp_of_image(lighting, image);
  const double power = max_channel(lamp.power) * lighting.exposure;
  const Connection centre = connect(lobe.space, lobe.point.ray_origin, image.samples[0], image.sheet);
  const double angular_size = centre.length > 1e-9 ? lamp.extent / centre.length : 4, radius = angular_size / 2;
  int count = std::clamp(static_cast<int>(image.samples.size()) - 1, 1, kMaxLampSamples);
  const auto widening = [&](int samples) { return lamp.extent > 0 ? std::min(0.25, radius * radius * std::numbers::pi / samples) : 0; };
  if (centre.valid && angular_size < 0.5) {
    const double light = power * image.max_throughput * lamp.peak_intensity *
                         falloff(lamp.falloff, lobe.space, std::max(centre.length - lamp.extent, lamp.radius), centre.arc, lamp.radius);
    if (light < lighting.options.cull_below) return {};
    const double bound = light * lobe.bound(centre.direction, 1.1 * angular_size, widening(count));
    if (bound < kMinHighlight) return {};
    if (lobe.share * bound < kMaxShadowStep) count = 1;  // the centre stands for the whole lamp
  }
  std::vector<LampSample> samples;
  samples.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const auto sample = static_cast<std::size_t>(count > 1 ? i + 1 : 0);
    const Connection connection = connect(lobe.space, lobe.point.ray_origin, image.samples[sample], image.sheet);
    if (!connection.valid) continue;
    const Color reflected = lobe.reflected(connection.direction, widening(count));
    if (max_channel(reflected) <= 0) continue;
    const Color unoccluded = unoccluded_irradiance(lighting, image, sample, lobe.point, connection) * reflected;
    if (power * max_channel(unoccluded) >= kMinHighlight / 2) samples.push_back({connection, sample, unoccluded});
  }
  if (samples.empty()) return {};
  return (1.0 / count) * (lamp.power * visible_highlight(lighting, image, lobe, samples, power, count));
}

}  // namespace

Color highlight(const LightingContext& lighting, const surface::ShadingPoint& point, const Direction& to_eye,
                const scene::Material& material, const Color& albedo, double share) {
  const Space space = lighting.scene.prism.space;
  const double alpha = surface::ggx_alpha(material);
  const SpecularLobe lobe{space, point, to_eye, surface::f0(material, albedo), alpha * alpha, trace::inner(space, point.normal, to_eye),
                          share};
  if (lobe.cos_eye <= 0) return {};
  Color sum;
  for (const std::uint32_t i : images_at(lighting, point.at)) sum = sum + image_highlight(lighting, lighting.lamps->images[i], lobe);
  if (material.kind != scene::MaterialKind::metal) return sum;
  return surface::multiscatter_compensation(lobe.f0, lobe.cos_eye, alpha) * sum;
}

}  // namespace orbc::light
