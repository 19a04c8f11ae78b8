#pragma once
#include "compiler/base/executor.h"
#include "compiler/base/progress.h"
#include "compiler/driver/open.h"
#include "compiler/render/film.h"

namespace orbc::driver {

struct TraceOptions {
  int samples = 1;                  ///< per pixel
};

/// prepare → draw: the lower road of compiler/README.md. Makes the same film for any executor.
[[nodiscard]] render::Film trace(const Opened& opened, const TraceOptions& options, const Executor& executor, const Progress& progress = {});

}  // namespace orbc::driver
