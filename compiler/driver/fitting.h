#pragma once
#include <functional>
#include <optional>

#include "compiler/base/result.h"
#include "compiler/driver/open.h"

namespace orbc::driver {

/// The most bounces below `too_many` for which `fits` holds, tried by halving: what fits with some bounces fits with fewer.
/// In:    a guess that is tried first. Makes: nothing when not even 0 fits.
[[nodiscard]] std::optional<int> most_bounces(int too_many, int guess, const std::function<bool(int)>& fits);

/// The same room seen from the same eye, with mirrors followed less far.
[[nodiscard]] Opened with_bounces(const Opened& opened, int max_bounces);

/// Replaces the hint of a cover that is too much, which stands for the one limit that was met, by bounces that pass all of them.
/// In: `fits`: whether the scene could be made with so many bounces.
[[nodiscard]] Diagnostics with_tried_hint(Diagnostics errors, int max_bounces, const std::function<bool(int)>& fits);

}  // namespace orbc::driver
