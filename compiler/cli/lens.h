#pragma once
#include "compiler/base/diagnostic.h"
#include "compiler/driver/load.h"

namespace orbc::cli {

/// A warning that so few samples of a pixel look through a lens in too few places to show a blur; nothing without a lens.
[[nodiscard]] Diagnostics few_lens_samples(const driver::LoadedScene& loaded, int samples);

/// Takes the lens out of the camera: exports, which the tracer's picture is compared with, have none.
/// Makes: a note that says so; nothing without a lens.
[[nodiscard]] Diagnostics leave_out_lens(driver::LoadedScene& loaded);

}  // namespace orbc::cli
