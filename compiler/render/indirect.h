#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "compiler/render/draw.h"
#include "compiler/surface/sampling.h"

namespace orbc::render {

/// The random numbers of one sample of a pixel. The samples form groups. Those of one group share a lattice that is shifted at random, from
/// which the beginnings of their light paths come. The spread between groups tells the error.
struct PixelSampler {
  static constexpr int kGroups = 4;
  surface::Random random{0};
  std::array<double, 6> shift{0.5, 0.5, 0.5, 0.5, 0.5, 0.5};  ///< of the group's lattice
  int lattice_index = 0;                                      ///< of the sample in its group
  light::SampleStratum stratum;                               ///< of lamp samples
  PixelSampler() = default;
  PixelSampler(std::uint64_t seed, std::uint64_t pixel, int sample, int samples);
  /// The stratum of a sample. Strata with equal remainders by any number lie apart in the pixel: on a square grid in diagonals.
  [[nodiscard]] static light::SampleStratum stratum_of(int sample, int samples);
  [[nodiscard]] static int group_of(int sample, int samples) { return sample % std::min(samples, kGroups); }
};

/// An estimate of ∫ radiance·cosθ dω/π at a matte point: the light that comes from all other surfaces of the room, by path tracing.
/// Makes: the mean over `paths` paths. Their directions come from light::Guide. Every segment is a geodesic over the real mirrors and
///        through mirror and glass objects. Every matte surface adds the light of its lamps (one shadow ray; the bodies of lamps are not
///        there, so nothing counts twice) and ambient light; emissive surfaces add their own. A path ends after
///        LightOptions::indirect_bounces surfaces, by Russian roulette, or where mirrors are followed no further, at the background.
/// Exact: unbiased, but for caustics (light of lamps over mirror, glass and metal objects) and highlights, which paths do not see.
[[nodiscard]] scene::Color indirect_irradiance(const place::Interior& interior, const light::LightingContext& lighting,
                                               const surface::ShadingPoint& from, PixelSampler& sampler, int paths = 1);

/// The noise of a path-traced picture: root mean square of its standard errors over all pixels, in steps of 1/255. 0 without noise.
[[nodiscard]] double rms_noise(const Film& film, double exposure);

}  // namespace orbc::render
