#pragma once
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

}  // namespace orbc::driver
