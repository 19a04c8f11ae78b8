// The light of a point: for every image of every lamp the geodesic to it, and shadow rays along it (connection.cpp) unless it cannot
// matter. The number of samples of a lamp follows from its upper bound: a step in its penumbra stays below what 8 bits show.
#include "compiler/light/lighting.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "compiler/light/connection.h"
#include "compiler/light/falloff.h"
#include "compiler/light/guide.h"
#include "compiler/surface/sampling.h"

namespace orbc::light {
namespace {

using geometry::Position;
using geometry::Space;
using scene::Color;

constexpr int kMaxPenumbraProbes = 32;         // samples that decide whether a point is in a penumbra
constexpr double kStepsPerProbe = 4;           // LightOptions::max_step: what may pass unseen between two of these samples
constexpr double kMaxStratumError = 8;         // LightOptions::max_step: error of a single stratum, for each image
constexpr double kStepsPerFaintRay = 0.5;      // LightOptions::max_step: of the sum of faint images, decided by one shadow ray
constexpr int kMinFaintRays = 8, kMaxFaintRays = 64;
constexpr double kMaxQuadratureExtent = 0.25;  // extent of a lamp / distance: the third order of the quadrature is then below 1.5 %

/// An estimate of what an image adds at a point; 0 only where it surely adds nothing.
double importance(const LightingContext& lighting, const LampImage& image, const surface::ShadingPoint& point) {
  const Space space = lighting.scene.prism.space;
  const PlacedLamp& lamp = lamp_of_image(lighting, image);
  const Connection centre = connect(space, point.ray_origin, image.samples[0], image.sheet);
  const double max_tilt = 2 * lamp.extent / std::max(centre.length, 1e-9);
  const double cosine = centre.valid ? trace::inner(space, centre.direction, point.normal) + max_tilt : 1;
  if (cosine <= 0 && max_tilt < 1) return 0;
  return image.multiplicity * max_channel(lamp.power) * image.max_throughput * std::clamp(cosine, 0.05, 1.0) *
         falloff(lamp.falloff, space, std::max(centre.length, lamp.radius), centre.arc, lamp.radius);
}

double image_bound(const LightingContext& lighting, const LampImage& image, double length, double arc) {
  return max_contribution(lighting.scene.prism.space, lamp_of_image(lighting, image), image.max_throughput, lighting.exposure, length, arc);
}

/// Beyond the quadrature, samples come in pairs that are mirror images about the lamp's centre, so their number must be even.
int round_up_to_even(double count) { return 2 * static_cast<int>(std::ceil(std::min(count, 1e6) / 2)); }

/// The samples of an image that one stratum takes: `count` of the first `pool` samples, cyclically from `first` on.
struct SampleBudget {
  int pool = 1, first = 0, count = 0;
  double weight = 1;  ///< of this image in this stratum: 1 / probability that the image is sampled at all
};

/// In: the upper bound of the image in steps (LightOptions::max_step); its index, so that faint images do not share their strata.
SampleBudget sample_budget(double steps, int samples, const SampleStratum& stratum, std::uint32_t image) {
  int pool = 1;
  if (samples > 0 && steps > 1) pool = std::clamp(round_up_to_even(steps), kQuadratureSamples, samples);
  if (stratum.count == 1) return {pool, 0, pool, 1};
  // A single stratum may be off by more than the mean of all. The error still shows where several surfaces share the pixel.
  steps /= std::min(kMaxStratumError, 2 * std::sqrt(stratum.count));
  const int count = std::clamp(static_cast<int>(std::ceil(steps)), 1, pool);
  if (steps >= 0.5) return {pool, stratum.index * count, count, 1};
  // A faint image is sampled by every n-th stratum with the weight n, where n divides the number of strata.
  int every = 1;
  for (int n = 2; n <= stratum.count && 2 * n * steps <= 1; ++n)
    if (stratum.count % n == 0) every = n;
  if ((static_cast<std::uint64_t>(stratum.index) + surface::splitmix64(image)) % static_cast<std::uint64_t>(every) != 0) return {};
  return {pool, stratum.index / every, 1, static_cast<double>(every)};
}

/// The irradiance from one image of a lamp, and how the point sees it.
struct ImageLight {
  Color irradiance;
  ImageVisibility visibility;
};

ImageVisibility visibility_of(const Color& throughput) {
  return {throughput == Color{} ? Visibility::blocked : Visibility::open,
          {static_cast<float>(throughput.r), static_cast<float>(throughput.g), static_cast<float>(throughput.b)}};
}
ImageVisibility visibility_of(bool samples_agree, int shadow_rays, const Color& throughput) {
  if (shadow_rays == 0) return {};
  return samples_agree ? visibility_of(throughput) : ImageVisibility{Visibility::partial, {}};
}

/// The irradiance per unit of power from an image that is wholly open: its centre if it is faint, else its quadrature where that suffices.
/// In: the distance to its centre; its upper bound.
double open_irradiance(const LightingContext& lighting, const LampImage& image, const surface::ShadingPoint& point, double length,
                       double bound) {
  const Space space = lighting.scene.prism.space;
  const bool is_point = image.samples.size() == 1 || bound <= lighting.options.max_step;
  const int all = is_point ? 1 : static_cast<int>(image.samples.size()) - 1;
  const int count = lamp_of_image(lighting, image).extent < kMaxQuadratureExtent * length ? std::min(kQuadratureSamples, all) : all;
  double light = 0;
  for (int i = 0; i < count; ++i) {
    const auto sample = static_cast<std::size_t>(is_point ? 0 : i + 1);
    const Connection connection = connect(space, point.ray_origin, image.samples[sample], image.sheet);
    const double cosine = connection.valid ? trace::inner(space, connection.direction, point.normal) : 0;
    if (cosine > 0) light += cosine * unoccluded_irradiance(lighting, image, sample, point, connection);
  }
  return light / count;
}

/// The faint images of a point.
struct FaintLight {
  struct Part {
    const LampImage* image = nullptr;
    Connection centre;
    double light = 0;  ///< irradiance if nothing blocked it, at the greatest throughput, in the lamp's strongest channel
  };
  std::vector<Part> parts;
  double sum = 0;  ///< of their light

  void add(const LightingContext& lighting, const LampImage& image, const surface::ShadingPoint& point, const Connection& centre) {
    const double cosine = centre.valid ? trace::inner(lighting.scene.prism.space, centre.direction, point.normal) : 0;
    if (cosine <= 0) return;
    const double light = image.multiplicity * image.max_throughput * max_channel(lamp_of_image(lighting, image).power) * cosine *
                         unoccluded_irradiance(lighting, image, 0, point, centre);
    if (light <= 0) return;
    parts.push_back({&image, centre, light});
    sum += light;
  }
};

/// The upper bound of what an image adds at a point, and whether the image is faint there.
struct PointBound {
  double bound = 0;
  bool is_faint = false, below_horizon = false;
};
PointBound bound_at(const LightingContext& lighting, const LampImage& image, const surface::ShadingPoint& point, const Connection& centre) {
  PointBound at{image_bound(lighting, image, centre.length, centre.arc), false, false};
  const double extent = lamp_of_image(lighting, image).extent;
  if (centre.valid) {  // the directions to samples differ from that to the centre by at most 2·extent / length
    const double cosine = trace::inner(lighting.scene.prism.space, centre.direction, point.normal) + 2 * extent / centre.length;
    at.below_horizon = cosine <= 0 && centre.length > 2 * extent;
    if (cosine < 1 && image.sheet == 0) at.bound *= std::max(cosine, 0.0);
  }
  at.is_faint = at.bound < lighting.faint_below;
  return at;
}

/// The light of faint images: their sum, times the mean transmittance of systematically sampled ones (Madow, Annals of Math. Statistics
/// 20, 1949). Strata of a pixel share the shadow rays.
Color faint_irradiance(const LightingContext& lighting, const FaintLight& faint, const surface::ShadingPoint& point,
                       const SampleStratum& stratum) {
  if (faint.sum <= 0) return {};
  const double shown = lighting.exposure / std::numbers::pi * faint.sum / std::max(lighting.options.max_step, 1e-9);
  const int wanted = std::clamp(static_cast<int>(std::ceil(std::min(shown / kStepsPerFaintRay, 1e6))), kMinFaintRays, kMaxFaintRays);
  const auto arriving = [&](const FaintLight::Part& part) {
    const LampImage& image = *part.image;
    const PlacedLamp& lamp = lamp_of_image(lighting, image);
    const Color throughput = shadow_transmittance(lighting, image, 0, point, part.centre);
    return (1 / (image.max_throughput * max_channel(lamp.power))) * (lamp.power * throughput);
  };
  Color sum;
  if (faint.parts.size() <= static_cast<std::size_t>(wanted) && stratum.count == 1) {
    for (const FaintLight::Part& part : faint.parts) sum = sum + part.light * arriving(part);
    return sum;
  }
  const int rays = std::max(1, (wanted + stratum.count - 1) / stratum.count);
  const double step = faint.sum / rays;
  double next = step * (stratum.index + 0.5) / stratum.count, before = 0;
  for (const FaintLight::Part& part : faint.parts) {
    const double end = before + part.light;
    int hits = 0;
    for (; next < end; next += step) ++hits;
    if (hits > 0) sum = sum + (hits * step) * arriving(part);
    before = end;
  }
  return sum;
}

/// In: where the image goes if it is faint.
ImageLight image_irradiance(const LightingContext& lighting, std::uint32_t number, const surface::ShadingPoint& point,
                            const SampleStratum& stratum, FaintLight& faint) {
  const LampImage& image = lighting.lamps->images[number];
  const Space space = lighting.scene.prism.space;
  const PlacedLamp& lamp = lamp_of_image(lighting, image);
  const Connection centre = connect(space, point.ray_origin, image.samples[0], image.sheet);
  const auto [bound, is_faint, below_horizon] = bound_at(lighting, image, point, centre);
  if (below_horizon) return {};
  if (is_faint) {
    faint.add(lighting, image, point, centre);
    return {};
  }
  const double steps = bound / lighting.options.max_step;
  const SampleBudget budget = sample_budget(steps, static_cast<int>(image.samples.size()) - 1, stratum, number);
  if (budget.count == 0) return {};
  // The quadrature alone gives the light of the whole lamp up to the third order in its extent (lamp.cpp). It suffices where the first
  // `probes` samples agree, so that no shadow border of visible height lies between them. Strata have too few samples for that.
  const bool quadrature_suffices = stratum.count == 1 && lamp.extent < kMaxQuadratureExtent * centre.length;
  const int probes =
      stratum.count == 1 ? std::clamp(round_up_to_even(steps / kStepsPerProbe), kQuadratureSamples, kMaxPenumbraProbes) : budget.count;
  Color sum, throughput, quadrature;
  int shadow_rays = 0;
  bool agree = true;
  for (int i = 0; i < budget.count; ++i) {
    const auto sample = static_cast<std::size_t>(budget.pool == 1 ? 0 : (budget.first + i) % budget.pool + 1);
    const Connection connection = connect(space, point.ray_origin, image.samples[sample], image.sheet);
    const double cosine = connection.valid ? trace::inner(space, connection.direction, point.normal) : 0;
    const double light = cosine > 0 ? cosine * unoccluded_irradiance(lighting, image, sample, point, connection) : 0;
    if (light > 0) {
      if (shadow_rays < probes || !agree) {
        const Color arriving = shadow_transmittance(lighting, image, sample, point, connection);
        agree = agree && (shadow_rays == 0 || arriving == throughput);
        throughput = arriving;
        ++shadow_rays;
      }
      sum = sum + light * throughput;
    }
    if (i + 1 == kQuadratureSamples) quadrature = sum;
    if (i + 1 == probes && quadrature_suffices && agree && shadow_rays == probes)
      return {(1.0 / kQuadratureSamples) * (lamp.power * quadrature), visibility_of(true, shadow_rays, throughput)};
  }
  return {(budget.weight / budget.count) * (lamp.power * sum), visibility_of(agree, shadow_rays, throughput)};
}

/// The irradiance from an image that is expected to be open or blocked. Nothing if a part of it is below the horizon, or if a shadow ray to
/// its centre tells otherwise. In: whether to trace that ray.
std::optional<ImageLight> expected_irradiance(const LightingContext& lighting, std::uint32_t number, const surface::ShadingPoint& point,
                                              const ImageVisibility& expected, bool check, FaintLight& faint) {
  if (expected.kind != Visibility::open && expected.kind != Visibility::blocked) return std::nullopt;
  const LampImage& image = lighting.lamps->images[number];
  const Space space = lighting.scene.prism.space;
  const PlacedLamp& lamp = lamp_of_image(lighting, image);
  const Connection centre = connect(space, point.ray_origin, image.samples[0], image.sheet);
  if (!centre.valid || centre.length <= 2 * lamp.extent) return std::nullopt;
  if (trace::inner(space, centre.direction, point.normal) <= 2 * lamp.extent / centre.length) return std::nullopt;
  const double bound = image_bound(lighting, image, centre.length, centre.arc);
  if (bound_at(lighting, image, point, centre).is_faint) {
    faint.add(lighting, image, point, centre);
    return ImageLight{};
  }
  Color throughput{static_cast<double>(expected.throughput[0]), static_cast<double>(expected.throughput[1]),
                   static_cast<double>(expected.throughput[2])};
  if (check) throughput = shadow_transmittance(lighting, image, 0, point, centre);
  const ImageVisibility seen = visibility_of(throughput);
  if (seen.kind != expected.kind) return std::nullopt;
  if (seen.kind == Visibility::blocked) return ImageLight{{}, seen};
  return ImageLight{open_irradiance(lighting, image, point, centre.length, bound) * (lamp.power * throughput), seen};
}

/// Adds the images that are not in a list to the faint ones. In: ascending indices.
void add_unlisted(const LightingContext& lighting, const std::vector<std::uint32_t>& listed, const surface::ShadingPoint& point,
                  FaintLight& faint) {
  const Space space = lighting.scene.prism.space;
  const auto add = [&](const LampImage& image) {
    faint.add(lighting, image, point, connect(space, point.ray_origin, image.samples[0], image.sheet));
  };
  const std::vector<LampImage>& images = lighting.lamps->images;
  if (listed.size() < images.size()) {
    std::size_t next = 0;
    for (std::uint32_t i = 0; i < images.size(); ++i) {
      if (next < listed.size() && listed[next] == i) ++next;
      else add(images[i]);
    }
  }
  for (const LampImage& image : lighting.lamps->faint) add(image);
}

}  // namespace

Color irradiance(const LightingContext& lighting, const surface::ShadingPoint& point, const SampleStratum& stratum) {
  return irradiance(lighting, point, ExpectedImages{images_at(lighting, point.at), {}}, stratum).irradiance;
}

Color irradiance(const LightingContext& lighting, const surface::ShadingPoint& point, const std::vector<std::uint32_t>& images) {
  return irradiance(lighting, point, ExpectedImages{images, {}}, {}).irradiance;
}

VisibleIrradiance irradiance(const LightingContext& lighting, const surface::ShadingPoint& point, const ExpectedImages& expected,
                             const SampleStratum& stratum) {
  constexpr std::uint32_t kCheckOneIn = 4;
  const std::size_t count = expected.images.size();
  std::vector<std::optional<ImageLight>> found(count);
  FaintLight faint;
  bool check_all = false;
  if (!expected.visibility.empty()) {
    for (std::size_t k = (kCheckOneIn - expected.phase % kCheckOneIn) % kCheckOneIn; k < count; k += kCheckOneIn) {
      const ImageVisibility& kind = expected.visibility[k];
      found[k] = expected_irradiance(lighting, expected.images[k], point, kind, true, faint);
      check_all = check_all || (!found[k] && (kind.kind == Visibility::open || kind.kind == Visibility::blocked));
    }
    for (std::size_t k = 0; k < count; ++k)
      if (!found[k]) found[k] = expected_irradiance(lighting, expected.images[k], point, expected.visibility[k], check_all, faint);
  }
  VisibleIrradiance sum;
  sum.visibility.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const ImageLight light = found[k] ? *found[k] : image_irradiance(lighting, expected.images[k], point, stratum, faint);
    sum.irradiance = sum.irradiance + light.irradiance;
    sum.visibility.push_back(light.visibility);
  }
  add_unlisted(lighting, expected.images, point, faint);
  sum.irradiance = sum.irradiance + faint_irradiance(lighting, faint, point, stratum);
  return sum;
}

std::vector<std::uint32_t> images_within(const LightingContext& lighting, const Position& centre, double radius, double share) {
  // On S² the falloff rises again towards a focus, so it gives no bound over a ball.
  const bool bounded = lighting.scene.prism.space != Space::spherical;
  std::vector<std::uint32_t> within;
  for (std::uint32_t i = 0; i < lighting.lamps->images.size(); ++i) {
    const LampImage& image = lighting.lamps->images[i];
    const Connection connection = connect(lighting.scene.prism.space, centre, image.samples[0], image.sheet);
    if (!bounded ||
        image_bound(lighting, image, connection.length - radius, std::max(connection.arc - radius, 0.0)) >= share * lighting.faint_below)
      within.push_back(i);
  }
  return within;
}

Color estimate_irradiance(const LightingContext& lighting, const surface::ShadingPoint& point, const std::array<double, 3>& u) {
  const Space space = lighting.scene.prism.space;
  // Reservoir sampling of one image in proportion to its importance. One number serves all decisions: after each it is stretched to [0, 1)
  // again (Chao, A general purpose unequal probability sampling plan, 1982).
  double total = 0, chosen_importance = 0, left = u[0];
  const LampImage* chosen = nullptr;
  const auto consider = [&](const LampImage& image) {
    const double own = importance(lighting, image, point);
    if (own <= 0) return;
    total += own;
    const double probability = own / total;
    if (left < probability) {
      chosen = &image;
      chosen_importance = own;
      left /= probability;
    } else {
      left = (left - probability) / (1 - probability);
    }
  };
  for (const LampImage& image : lighting.lamps->images) consider(image);
  for (const LampImage& image : lighting.lamps->faint) consider(image);
  if (!chosen) return {};
  const std::size_t count = chosen->samples.size() - 1;
  const std::size_t sample = count == 0 ? 0 : 1 + std::min(count - 1, static_cast<std::size_t>(u[1] * static_cast<double>(count)));
  const Connection connection = connect(space, point.ray_origin, chosen->samples[sample], chosen->sheet);
  if (!connection.valid) return {};
  const double cosine = trace::inner(space, connection.direction, point.normal);
  if (cosine <= 0) return {};
  const double light = cosine * unoccluded_irradiance(lighting, *chosen, sample, point, connection);
  if (light <= 0) return {};
  const Color throughput = shadow_transmittance(lighting, *chosen, sample, point, connection);
  return (chosen->multiplicity * light * total / chosen_importance) * (lamp_of_image(lighting, *chosen).power * throughput);
}

Color outgoing_radiance(const LightingContext& lighting, const scene::Material& material, const Color& albedo, const Color& e) {
  return material.kind == scene::MaterialKind::emissive ? material.emission * albedo
                                                        : albedo * (lighting.ambient + (1 / std::numbers::pi) * e);
}

double white_level(const LightingContext& lighting) { return 1 / std::max(lighting.exposure, 1e-300); }

surface::ShadingPoint shading_point(const LightingContext& lighting, const place::Interior& interior, const trace::SurfacePoint& point,
                                    const trace::Hit& hit) {
  if (hit.kind == trace::HitKind::triangle) {
    const auto part = static_cast<std::size_t>(hit.part);
    return surface::shading_point(interior, interior.parts[part], lighting.normals[part], static_cast<std::size_t>(hit.triangle),
                                  {hit.b[0], hit.b[1], hit.b[2]});
  }
  return {point.at, point.normal, point.at, point.wall, false};
}

}  // namespace orbc::light
