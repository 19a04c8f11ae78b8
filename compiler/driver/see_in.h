#pragma once
#include "compiler/base/executor.h"
#include "compiler/driver/open.h"
#include "compiler/light/highlight_bake.h"

namespace orbc::driver {

/// What the tracer sees in mirror and glass objects, asked point by point: so exports show them truly to their eye, though their renderer's
/// rays are straight.
/// In:    an opened scene that outlives the answer.
/// Error: that of the tracer; of coarser levels of an object the points are those of the object itself nearest in sight.
[[nodiscard]] light::SeenIn see_in(const Opened& opened, const Executor& executor);

}  // namespace orbc::driver
