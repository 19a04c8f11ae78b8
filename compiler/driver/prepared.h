#pragma once
#include "compiler/base/executor.h"
#include "compiler/driver/open.h"
#include "compiler/light/lighting.h"
#include "compiler/trace/follow.h"

namespace orbc::driver {

/// What rays meet in a scene, and how it is lit: what the tracer, the bake and whatever looks into the room all ask.
struct Prepared {
  orbc::trace::TraceScene scene;
  light::LightingContext light;
};

/// Made once for an opened scene, when it is first asked for, and kept with it. In: not called from several threads at once.
[[nodiscard]] const Prepared& prepared(const Opened& opened, const Executor& executor);

}  // namespace orbc::driver
