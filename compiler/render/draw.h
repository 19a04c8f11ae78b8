#pragma once
#include <limits>
#include <vector>

#include "compiler/bake/baked_light.h"
#include "compiler/bake/irradiance_cache.h"
#include "compiler/base/executor.h"
#include "compiler/base/progress.h"
#include "compiler/light/lighting.h"
#include "compiler/place/camera.h"
#include "compiler/render/film.h"
#include "compiler/render/straight.h"
#include "compiler/trace/follow.h"

namespace orbc::render {

struct DrawOptions {
  int samples = 1;                                    ///< per pixel: 1 is the centre, n² a regular grid, other numbers a rank-1 lattice
  int max_bounces = 12;                               ///< mirrors of the room on one path
  double min_weight = 0;                              ///< throughput below which a path is cut off
  int max_depth = 16;                                 ///< mirror, glass and metal objects on one path
  int specular_samples = 256;                         ///< most directions sampled for the room in a rough metal, by all samples of a pixel
  int paths = 8;                                      ///< `integrator: path`: paths of indirect light per sample
  const light::LightingContext* lighting = nullptr;   ///< of this room; null: scenes without lamps, where surfaces show their albedo
  bool highlights = true;                             ///< of lamps on glossy surfaces
  const StraightRays* straight = nullptr;             ///< if given, the eye's rays are straight in the disk chart
  const bake::BakedLight* baked = nullptr;            ///< if given, matte light is looked up here
  const bake::IrradianceCache* irradiance = nullptr;  ///< if given, the light of lamps on matte surfaces is looked up here
  scene::Color background;                            ///< radiance where a path is cut off
  double max_radiance = std::numeric_limits<double>::infinity();  ///< of surfaces in scenes without lamps, whose colours are no light
};

/// Draws the reference picture: the rays of every pixel, followed as geodesics over real mirrors. It never unfolds the room and never bends
/// meshes. An eye with a lens sends each sample from another point of the lens.
/// Makes: the same film, bit by bit, for any executor: samples are fixed points of the pixel, and pixels are independent.
[[nodiscard]] Film draw(const trace::TraceScene& scene, const place::Camera& eye, const DrawOptions& options, const Executor& executor,
                        const Progress& progress = {});

/// Draws some pixels of a film again; what the others show stays. In: for each pixel, row by row, whether it is drawn.
/// Makes: the same film, bit by bit, for any executor.
void redraw(const trace::TraceScene& scene, const place::Camera& eye, const DrawOptions& options, const std::vector<bool>& wanted,
            Film& film, const Executor& executor, const Progress& progress = {});

/// The geodesic from the eye through the point (x, y) of the picture, in pixels.
[[nodiscard]] trace::Ray eye_ray(const place::Camera& eye, double x, double y);

/// The samples of a pixel: points of [0, 1)².
[[nodiscard]] std::vector<std::array<double, 2>> sample_points(int samples);

}  // namespace orbc::render
