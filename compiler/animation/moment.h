#pragma once
#include <functional>

#include "compiler/base/result.h"
#include "compiler/scene/override.h"
#include "compiler/scene/read.h"

namespace orbc::animation {

/// Reads the scene with some of its values replaced.
using ReadScene = std::function<Result<scene::ReadResult>(const scene::Overrides&)>;

/// The values that the scene has at a moment, as overrides that also remove `animation`: with them it reads as a still.
/// Keyframes come first, in the order of the file; then the corners of the orbifold (`orbifold.corners.3`); then what moves through the
/// room as it is at that moment; and at last the directions that follow from motions (`ahead`).
/// In:          t in 0…1; `read`, which is called at most twice.
/// Diagnostics: animation.*, and those of reading and of realising the room.
[[nodiscard]] Result<scene::Overrides> overrides_at(const scene::Animation& animation, double t, const ReadScene& read);

/// The same for frame `frame` (from 0): t = frame/frames, and random numbers of its own unless `seed: locked`.
[[nodiscard]] Result<scene::Overrides> overrides_of_frame(const scene::Animation& animation, int frame, const ReadScene& read);

}  // namespace orbc::animation
