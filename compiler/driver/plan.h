#pragma once
#include "compiler/driver/draw_list.h"

namespace orbc::driver {

/// Why a scene has no export at all. Makes: no diagnostics when it has some.
/// Diagnostics: driver.glowing-mirror.
[[nodiscard]] Diagnostics unsupported_features(const PreparedScene& scene, const place::Camera& eye, bend::View view);

/// Plans a picture whose copies and levels of detail are chosen: estimates its size from a sample of the copies. Bakes nothing.
[[nodiscard]] Result<cover::Plan> plan_detail(const Job& job, const Detail& detail);

/// Whether a product is small enough for the memory allowed. Only those that may exceed it are estimated.
/// Makes: no diagnostics when it fits.
/// Diagnostics: cover.too-much; those of bend.
[[nodiscard]] Diagnostics check_memory(const Job& job, const Detail& detail, const DrawList& list);

/// The errors of a picture, with bounces that fit in the hint where fewer bounces would help, and with the place of the scene.
[[nodiscard]] Diagnostics with_bounces_that_fit(Diagnostics errors, const Job& job);

}  // namespace orbc::driver
