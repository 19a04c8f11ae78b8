#pragma once
#include <functional>
#include <optional>

#include "compiler/base/executor.h"
#include "compiler/base/progress.h"
#include "compiler/driver/prepare.h"
#include "compiler/render/draw.h"

namespace orbc::driver {

struct TraceOptions {
  int samples = 1;                                   ///< per pixel
  bool exact = false;                                ///< light every sample of the picture by itself; else matte light is interpolated
  std::optional<scene::BakeQuality> path_quality{};  ///< of light between surfaces; nothing: that of the scene
};

/// How the tracer draws a scene for an eye. The options refer to the scene's light.
[[nodiscard]] render::DrawOptions draw_options(const PreparedScene& scene, const place::Camera& eye, const Run& run);

/// Traces the reference picture of a scene: the lower road of compiler/README.md. Makes: the same film for any executor.
[[nodiscard]] render::Film trace_film(const PreparedScene& scene, const place::Camera& eye, const TraceOptions& options,
                                      const Executor& executor, const Progress& progress = {});
/// The same for the scene's own camera and nothing else.
[[nodiscard]] render::Film trace_film(const LoadedScene& scene, const TraceOptions& options, const Executor& executor,
                                      const Progress& progress = {});

/// When a picture is smooth enough.
struct NoiseTarget {
  double noise = 1.0 / 255;  ///< largest error of a pixel as it is shown, as a share of white's code; > 0
  int max_samples = 1024;    ///< per pixel
  bool exact = false;        ///< as TraceOptions::exact
};

/// A picture while its noise goes down.
struct FilmPass {
  const render::Film& film;
  int samples = 1;          ///< most of a pixel so far
  double mean_samples = 1;  ///< all samples that were traced, over the pixels
  double unsettled = 1;     ///< share of the pixels that are noisier than the target
};

/// Traces a picture in passes of 1, 4, 16, 64… samples a pixel, until each is smooth enough or has max_samples. The third pass draws
/// only what is not settled and what lies beside it, those after it what is not settled.
/// In:     `after_pass` is called with the whole picture after each pass; what it is given is a picture of the scene at any time.
/// Makes:  the same film for any executor.
/// Error:  a pixel counts as settled when what its last pass has changed tells an error within the target, and where chance remains
///         (`integrator: path`) its standard error does too. The first of these is an estimate: what is thinner than half a pixel may be
///         missed.
[[nodiscard]] render::Film trace_to_noise(const PreparedScene& scene, const place::Camera& eye, const NoiseTarget& target,
                                          const Executor& executor, const std::function<void(const FilmPass&)>& after_pass,
                                          const Progress& progress = {});

}  // namespace orbc::driver
