#pragma once
#include "compiler/cli/commands.h"
#include "compiler/driver/open.h"

namespace orbc::cli {

/// Says that so few samples of a pixel look through a lens in too few places to show a blur.
void tell_of_lens(const driver::Opened& opened, int samples, const Common& common);

/// Takes the lens out of the camera, and says so: exports, which the tracer's picture is compared with, have none.
void leave_out_lens(driver::Opened& opened, const Common& common);

}  // namespace orbc::cli
