#pragma once
#include "compiler/base/executor.h"
#include "compiler/base/progress.h"
#include "compiler/driver/open.h"
#include "compiler/render/draw.h"

namespace orbc::driver {

struct TraceOptions {
  int samples = 1;  ///< per pixel
};

/// How the tracer looks at a scene. In: its light, which must outlive the options.
[[nodiscard]] render::DrawOptions draw_options(const Opened& opened, const light::LightingContext& light, const Executor& executor);

/// prepare → draw: the lower road of compiler/README.md. Makes the same film for any executor.
[[nodiscard]] render::Film trace(const Opened& opened, const TraceOptions& options, const Executor& executor,
                                 const Progress& progress = {});

}  // namespace orbc::driver
