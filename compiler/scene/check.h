#pragma once
#include "compiler/base/diagnostic.h"
#include "compiler/scene/scene.h"

namespace orbc::scene {

/// What is wrong with a scene as a whole, as far as that shows without its geometry. The reader calls it; whoever makes or changes a scene
/// in memory can call it too. Single values (ranges, types) are the reader's business.
/// Diagnostics: scene.unknown-object, scene.looks-at-itself, scene.outside-space, scene.wall-count; warnings scene.stretched.
[[nodiscard]] Diagnostics check(const Scene& scene);

/// The farthest that a lens can focus. In H² what is farther is not told from it; on S² all rays from the lens to the antipode of the eye
/// leave along its rim, so that near there no picture is left.
inline constexpr double kFarthestFocusHyperbolic = 20;
inline constexpr double kFarthestFocusSpherical = 3;

/// The sign of the curvature of the room's space: +1 S², 0 E², −1 H²; from χ in exact rationals (design §3).
[[nodiscard]] int curvature_sign(const notation::Orbifold& orbifold);

}  // namespace orbc::scene
