#pragma once
#include "compiler/driver/compile.h"

namespace orbc::driver {

/// Whether pictures of a scene show its disk chart by straight rays. In flat rooms geodesics are straight already.
[[nodiscard]] bool draws_straight(const scene::Scene& scene);

/// The options by which exports of a scene with `rays: straight` are made: the disk chart, scaled so that it is true to length at the
/// room's centre, with tolerances for an eye at the camera's place in it. Those of other scenes, and of --view disk, stay as they are.
[[nodiscard]] CompileOptions with_rays(CompileOptions options, const scene::Scene& scene, const place::Camera& eye);

/// Says what straight rays leave out.
/// Makes: the note driver.straight-light for lit scenes with surfaces whose look depends on the eye.
[[nodiscard]] Diagnostics straight_note(const LoadedScene& loaded);

}  // namespace orbc::driver
