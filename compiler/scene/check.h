#pragma once
#include "compiler/base/diagnostic.h"
#include "compiler/scene/scene.h"

namespace orbc::scene {

/// Checks a scene as a whole, as far as that is possible without its geometry. The reader calls it; programs that make or change scenes in
/// memory can call it too. It does not check ranges and types of single values, which the reader does. Diagnostics: scene.unknown-object,
/// scene.looks-at-itself, scene.outside-space, scene.wall-count; warnings scene.stretched.
[[nodiscard]] Diagnostics check(const Scene& scene);

/// The largest distances at which a lens can focus, in curvature radii. In H² all larger distances look the same. On S² all rays from the
/// lens to the antipode of the eye leave along its rim, so that no image is formed near there.
inline constexpr double kMaxFocusDistanceHyperbolic = 20;
inline constexpr double kMaxFocusDistanceSpherical = 3;

/// The sign of the curvature of the room's space: +1 S², 0 E², −1 H². Exact: from χ in rationals (design §3).
[[nodiscard]] int curvature_sign(const notation::Orbifold& orbifold);

}  // namespace orbc::scene
