#pragma once
#include <functional>
#include <optional>

#include "compiler/base/result.h"

namespace orbc::driver {

/// The largest number of bounces below `too_many` for which `fits` holds, found by halving. What fits with some bounces fits with fewer.
/// In:    a guess that is tried first.
/// Makes: nothing when not even 0 fits.
[[nodiscard]] std::optional<int> max_fitting_bounces(int too_many, int guess, const std::function<bool(int)>& fits);

/// Corrects the hint of errors that say that a cover is too large. Such a hint names bounces that pass the one limit that was exceeded; the
/// corrected hint names bounces that pass all of them.
/// In: `fits`: whether the scene can be made with so many bounces.
[[nodiscard]] Diagnostics with_fitting_bounces(Diagnostics errors, int max_bounces, const std::function<bool(int)>& fits);

}  // namespace orbc::driver
