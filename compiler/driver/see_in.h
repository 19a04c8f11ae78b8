#pragma once
#include "compiler/bake/view_dependent.h"
#include "compiler/base/executor.h"
#include "compiler/driver/open.h"

namespace orbc::driver {

/// What the tracer sees in mirror, glass and metal objects, asked point by point: so exports show them truly to their eye, though their
/// renderer's rays are straight.
/// In:    an opened scene, and what was baked of it, which outlive the answer. Without the latter all that is seen is lit point by point,
///        with `integrator: path` by one guess each.
/// Error: that of the tracer, and of the texels of what was baked.
[[nodiscard]] bake::SpecularQuery see_in(const Opened& opened, const bake::DiffuseBake* baked, const Executor& executor);

}  // namespace orbc::driver
