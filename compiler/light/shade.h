#pragma once
#include <memory>
#include <vector>

#include "compiler/base/executor.h"
#include "compiler/light/image.h"
#include "compiler/light/near.h"
#include "compiler/surface/albedo.h"
#include "compiler/surface/normals.h"
#include "compiler/trace/follow.h"

namespace orbc::light {

struct LightOptions {
  int bounces = 2;            ///< mirrors that the light of lamps is followed over
  double step = 0.006;        ///< of white: what one sample of a lamp may add to a point; its shadows have such steps
  int passes = 0;             ///< how often matte surfaces may pass light on to each other; 0: `integrator: direct`
  int leg_bounces = 12;       ///< of light that surfaces pass on: mirrors from one surface to the next,
  double leg_min_weight = 0;  ///< and the weight below which it is cut off;
  scene::Color background;    ///< then this is seen, times the weight of the path
  std::uint64_t seed = 1;     ///< of random numbers, for pictures that need them
  double cut = 1.0 / 1000;    ///< images that could add less than this to a white surface (white = 1 in the picture) are left out
};

/// What the author of a scene says of them.
[[nodiscard]] LightOptions light_options(const scene::Scene& scene);

/// All that is needed to light a point of a room; made once for a scene, shared by both roads.
struct LightField {
  bool lit = false;  ///< false: a scene with neither lamps nor `integrator: path`, shown in its plain colours
  scene::Color ambient;
  double exposure = 1;
  LightOptions options;
  std::vector<HungLamp> lamps;
  std::vector<LampImage> images;
  NearImages near;                                   ///< which of them matter where
  std::vector<surface::PartNormals> normals;         ///< per part of the room
  std::shared_ptr<const place::PlacedRoom> casting;  ///< what casts shadows: the room without the bodies of its lamps
  trace::TraceScene scene;                           ///< of `casting`
};

/// Hangs the lamps, finds their images, prepares shadows. In: the room with its fixtures (add_fixtures). A scene without lamps costs
/// nothing.
[[nodiscard]] Result<LightField> prepare_light(const scene::Scene& scene, const place::PlacedRoom& room, const LightOptions& options = {},
                                               const Executor& executor = serial_executor());

/// Many samples of one pixel share out what they ask of the lamps: together they ask as much as is needed, each a part of it.
struct Turn {
  int rank = 0;  ///< of this sample; those of every class of remainders must be spread over the pixel
  int of = 1;    ///< samples of the pixel; 1: asks all by itself
};

/// Power per area that falls on a surface point from all lamps, straight and over mirrors.
/// Units:  a lamp of power Φ gives Φ/(4πr²) at distance r in E², face on. Ambient light is not in it.
/// Error:  shadows of lamps with an extent are those of at most 128 points; images below `cut` are left out; light that comes by surfaces
///         other than mirrors is not in it. Of a turn the mean over all turns counts; alone it may be off by 8 steps for each image.
[[nodiscard]] scene::Color irradiance(const LightField& field, const surface::LightPoint& point, const Turn& turn = {});
/// The same from some of the images.
[[nodiscard]] scene::Color irradiance(const LightField& field, const surface::LightPoint& point, const std::vector<std::uint32_t>& images);
/// The images that can add anything at points within `radius` of a position: for many points that lie together. `share`: of the cut.
[[nodiscard]] std::vector<std::uint32_t> images_near(const LightField& field, const geometry::Position& centre, double radius,
                                                     double share = 1);

/// A guess of `irradiance` from one shadow ray to one sample of one image: its mean over even numbers u in [0, 1) is the irradiance.
[[nodiscard]] scene::Color irradiance_guess(const LightField& field, const surface::LightPoint& point, const std::array<double, 3>& u);

/// What a matte surface of the given colour sends to every eye: colour × (ambient + E/π), so that white under E = π shows as white at
/// exposure 1; emissive ones emission × colour. Never more than white after exposure: a picture of the room, hung into all copies, holds no
/// more, and both roads must agree.
/// In: what comes to it from other surfaces is part of `irradiance`, times π.
[[nodiscard]] scene::Color radiance_out(const LightField& field, const scene::Material& material, const scene::Color& albedo,
                                        const scene::Color& irradiance);
/// What shows as white: the most that any surface sends to the eye.
[[nodiscard]] double white_of(const LightField& field);

/// The point that a ray has met, made ready to be lit.
[[nodiscard]] surface::LightPoint light_point(const LightField& field, const place::PlacedRoom& room, const trace::SurfacePoint& point,
                                              const trace::Hit& hit);

/// The light of glossy and metal surfaces that a matte one does not have: the lamps' reflections in it, towards the eye. What else metals
/// mirror is render's: the room in their facets (lobe.h).
/// Formula: GGX (Walter et al., Microfacet Models for Refraction, 2007) with Smith's shadowing and Schlick's Fresnel; α = roughness². Of a
/// lamp with an extent its points count one by one, and as many shadow rays as it is bright.
/// Error:   highlights that cannot reach 1/3000 of white are left out; steps of shadows in them are up to 1/400 of white.
[[nodiscard]] scene::Color highlight(const LightField& field, const surface::LightPoint& point, const trace::Direction& to_eye,
                                     const scene::Material& material, const scene::Color& albedo);

}  // namespace orbc::light
