#pragma once
#include "compiler/bake/view_dependent.h"
#include "compiler/driver/prepare.h"

namespace orbc::driver {

/// A query of the tracer for what the eye sees in mirror, glass and metal objects, point by point. So exports show it as the eye sees it,
/// though the rays of their renderer are straight.
/// In:    a scene and what was baked of it, which outlive the query. `baked` null: surfaces that are seen are lit point by point, with
///        `integrator: path` by one random sample each.
/// Error: that of the tracer, and of the texels of what was baked.
[[nodiscard]] bake::SpecularQuery specular_query(const PreparedScene& scene, const place::Camera& eye, const bake::DiffuseBake* baked,
                                                 const Run& run);

}  // namespace orbc::driver
