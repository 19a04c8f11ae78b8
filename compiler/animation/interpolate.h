#pragma once
#include "compiler/base/result.h"
#include "compiler/scene/animation.h"

namespace orbc::animation {

/// The value of keyframes at a moment.
/// Numbers run linearly, angles too, colors in linear light, lists and maps item by item. Other values must be the same at both ends,
/// or the interpolation `step`.
/// In:          t in 0…1.
/// Diagnostics: animation.no-interpolation, placed at the later value.
[[nodiscard]] Result<scene::Node> value_at(const scene::Keyframes& keyframes, double t);

}  // namespace orbc::animation
