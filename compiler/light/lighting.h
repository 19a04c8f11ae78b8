#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "compiler/base/executor.h"
#include "compiler/light/lamp_image.h"
#include "compiler/light/light_cull_grid.h"
#include "compiler/surface/normals.h"
#include "compiler/trace/follow.h"

namespace orbc::light {

struct LightOptions {
  int bounces = 2;                 ///< most mirrors between a lamp and the surface it lights
  double max_step = 0.006;         ///< white = 1: the most that one sample of a lamp adds to a point; shadows have steps of this size
  int indirect_bounces = 0;        ///< most matte surfaces on a path of indirect light; 0: no indirect light (`integrator: direct`)
  int path_bounces = 12;           ///< indirect light: most mirrors between two surfaces,
  double path_min_weight = 0;      ///< and the throughput of these mirrors below which a path is cut off
  scene::Color background;         ///< radiance where a path is cut off
  std::uint64_t seed = 1;          ///< of random numbers, for pictures that need them
  double cull_below = 1.0 / 1000;  ///< white = 1: images that could add less to a white surface are faint; their highlights are left out
};

/// The options that a scene asks for.
[[nodiscard]] LightOptions light_options(const scene::Scene& scene);

/// The lamps of a scene and their mirror images.
struct LampSet {
  std::vector<PlacedLamp> lamps;
  std::vector<LampImage> images;
  Diagnostics warnings;          ///< those of place_lamps
  std::vector<LampImage> faint;  ///< images, as in LampImages
  double faint_share = 1;        ///< LampImages::faint_below / LightOptions::cull_below: below 1 in dim rooms
};
/// Places the lamps of a scene and finds their images. In: the room without lamp bodies; the options that prepare_light gets.
/// Diagnostics: those of place_lamps, lamps_inside_objects and lamp_images.
[[nodiscard]] Result<LampSet> prepare_lamps(const scene::Scene& scene, const place::Interior& interior, const LightOptions& options);

/// All that is needed to light a point of a room. Made once for a scene, shared by the tracer and the bake. Copies share what is large.
struct LightingContext {
  bool lit = false;  ///< false: neither lamps nor `integrator: path`; surfaces show their albedo
  scene::Color ambient;
  double exposure = 1;
  LightOptions options;
  double faint_below = 0;  ///< white = 1: where an image could add less, it is part of a sum (irradiance); at most options.cull_below
  std::shared_ptr<const LampSet> lamps = std::make_shared<const LampSet>();
  LightCullGrid cull_grid;                                ///< which images matter where
  std::vector<surface::PartNormals> normals;              ///< per part of the room
  std::shared_ptr<const place::Interior> shadow_casters;  ///< the room without the bodies of its lamps
  trace::TraceScene scene;                                ///< of `shadow_casters`
};

/// The lamp of an image.
[[nodiscard]] inline const PlacedLamp& lamp_of_image(const LightingContext& lighting, const LampImage& image) {
  return lighting.lamps->lamps[static_cast<std::size_t>(image.lamp)];
}

/// Prepares shadow rays and the normals of all parts. In: the room with lamp bodies (with_lamp_bodies); the scene's lamps.
[[nodiscard]] LightingContext prepare_light(const scene::Scene& scene, const place::Interior& interior,
                                            std::shared_ptr<const LampSet> lamps, const LightOptions& options = {},
                                            const Executor& executor = serial_executor());
/// The same for a scene whose lamps have not been prepared. Diagnostics: those of place_lamps and lamp_images.
[[nodiscard]] Result<LightingContext> prepare_light(const scene::Scene& scene, const place::Interior& interior,
                                                    const LightOptions& options = {}, const Executor& executor = serial_executor());

/// Lamp samples are stratified over the samples of a pixel: stratum `index` of `count`. The mean over all strata has full accuracy.
struct SampleStratum {
  int index = 0;  ///< strata with equal remainders by any number should lie apart in the pixel
  int count = 1;  ///< 1: not stratified, full accuracy
};

/// The irradiance at a surface point from all lamps, directly and over mirrors.
/// Units:  a lamp of power Φ gives Φ/(4πr²) at distance r in E², at normal incidence. Ambient light is not part of it.
/// Makes:  images that are faint at the point are summed without shadows, and a few shadow rays, drawn in proportion to their light, tell
///         how much of the sum arrives. No image is left out.
/// Error:  lamps with an extent have at most 128 samples; of the faint sum one shadow ray decides at most half a step (LightOptions::
///         max_step), and at most an eighth of the sum. A single stratum is off by up to 8 steps for each image.
[[nodiscard]] scene::Color irradiance(const LightingContext& lighting, const surface::ShadingPoint& point,
                                      const SampleStratum& stratum = {});
/// The same from some of the images.
[[nodiscard]] scene::Color irradiance(const LightingContext& lighting, const surface::ShadingPoint& point,
                                      const std::vector<std::uint32_t>& images);
/// How much of a lamp's image a point sees. `unknown` where it was not asked, as below the horizon.
enum class Visibility : std::uint8_t { unknown, blocked, open, partial };
/// The same with the throughput of the mirrors on the path, if it is open.
struct ImageVisibility {
  Visibility kind = Visibility::unknown;
  std::array<float, 3> throughput{};
  bool operator==(const ImageVisibility&) const = default;
};
/// Irradiance, and how each image is seen, for neighbouring points.
struct VisibleIrradiance {
  scene::Color irradiance;
  std::vector<ImageVisibility> visibility;  ///< parallel to the images
};
/// What neighbouring points tell of the images at a point.
struct ExpectedImages {
  const std::vector<std::uint32_t>& images;
  const std::vector<ImageVisibility>& visibility;  ///< parallel to `images`, or empty
  std::uint32_t phase = 0;  ///< chooses the images that are checked: points near each other should have different ones
};
/// The same where neighbouring points tell how images are seen.
/// Makes: images expected to be open or blocked are taken for that, in every stratum alike. One in four is checked by a shadow ray to its
///        centre; if any check tells otherwise, all are checked. Where a check fails, or where `partial` or `unknown` is expected, an
///        image is sampled as its stratum is.
/// Error: borders of shadows that no check meets are missed.
[[nodiscard]] VisibleIrradiance irradiance(const LightingContext& lighting, const surface::ShadingPoint& point,
                                           const ExpectedImages& expected, const SampleStratum& stratum = {});
/// Indices of the images that may matter at points within `radius` of a position. In: `share` of LightingContext::faint_below that matters.
/// Makes: ascending indices.
[[nodiscard]] std::vector<std::uint32_t> images_within(const LightingContext& lighting, const geometry::Position& centre, double radius,
                                                       double share = 1);

/// An unbiased estimate of `irradiance` by one shadow ray to one sample of one image. In: numbers u in [0, 1), uniform.
[[nodiscard]] scene::Color estimate_irradiance(const LightingContext& lighting, const surface::ShadingPoint& point,
                                               const std::array<double, 3>& u);

/// The radiance of a matte surface: albedo × (ambient + E/π), or emission × albedo if it is emissive. E = π shows as white at exposure 1.
/// In:    the irradiance E from lamps, and π times the indirect light if there is any.
/// Makes: linear light without an upper bound: what is above white may be dimmed by mirrors.
[[nodiscard]] scene::Color outgoing_radiance(const LightingContext& lighting, const scene::Material& material, const scene::Color& albedo,
                                             const scene::Color& irradiance);
/// The radiance that shows as white: the most that pictures show.
[[nodiscard]] double white_level(const LightingContext& lighting);

/// The shading point that a ray has hit.
[[nodiscard]] surface::ShadingPoint shading_point(const LightingContext& lighting, const place::Interior& interior,
                                                  const trace::SurfacePoint& point, const trace::Hit& hit);

/// The radiance that a glossy or metal surface reflects specularly from the lamps towards the eye. The room in metals is not part of it.
/// Formula: GGX (surface/ggx.h) with α = roughness². Lamps with an extent are sums over their samples.
/// In:      `share` of a pixel that the highlight is part of, at most 1: with less, lamps have fewer samples.
/// Error:   highlights below 1/3000 of white are left out; their shadows have steps of up to 1/400 of white in the pixel.
[[nodiscard]] scene::Color highlight(const LightingContext& lighting, const surface::ShadingPoint& point, const trace::Direction& to_eye,
                                     const scene::Material& material, const scene::Color& albedo, double share = 1);

}  // namespace orbc::light
