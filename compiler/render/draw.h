#pragma once
#include <limits>

#include "compiler/bake/baked_light.h"
#include "compiler/base/executor.h"
#include "compiler/base/progress.h"
#include "compiler/light/shade.h"
#include "compiler/place/eye.h"
#include "compiler/render/film.h"
#include "compiler/trace/follow.h"

namespace orbc::render {

struct DrawOptions {
  int samples = 1;  ///< per pixel; 1 = the pixel's centre, n² = a regular grid, else a rank-1 lattice
  int max_bounces = 12;
  double min_weight = 0;
  int max_depth = 16;                        ///< mirror, glass and metal objects met on one path
  int glances = 256;                         ///< ways, at most, on which rough metals are seen to mirror the room; all samples together
  int paths = 8;                             ///< `integrator: path`: paths of light from a sample's surface on
  const light::LightField* light = nullptr;  ///< of this room, for scenes with lamps; else plain colours are shown
  const bake::BakedLight* baked = nullptr;   ///< where given, what is matte is looked up there instead of being lit
  scene::Color background;                   ///< seen where a path is cut off, times the path's weight like everything else
  /// The most that a surface shows in scenes without light (lit ones: light::white_of)
  double white = std::numeric_limits<double>::infinity();
};

/// The reference picture: every pixel's rays followed as geodesics through real mirrors. Never unfolds, never bends. An eye with a lens
/// sends each sample from another point of it.
/// Makes: the same film, bit by bit, for any executor: samples are fixed points of the pixel, pixels are independent.
[[nodiscard]] Film draw(const trace::TraceScene& scene, const place::Eye& eye, const DrawOptions& options, const Executor& executor,
                        const Progress& progress = {});

/// The geodesic that starts at the eye through the picture at (x, y) pixels.
[[nodiscard]] trace::Ray eye_ray(const place::Eye& eye, double x, double y);

/// Offsets of the samples of a pixel, in [0, 1)².
[[nodiscard]] std::vector<std::array<double, 2>> sample_points(int samples);

}  // namespace orbc::render
