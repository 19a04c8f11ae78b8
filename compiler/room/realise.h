#pragma once
#include "compiler/base/result.h"
#include "compiler/room/room.h"
#include "compiler/scene/scene.h"

namespace orbc::room {

inline constexpr double kMinScale = 1e-9, kMaxScale = 1e9;  ///< bounds of `scale`, `aspect` and `strip_length`

/// Realises the polygon of an orbifold in its space and certifies it.
/// In:          corners in the author's order; real-valued ones only with `allow_non_orbifold`.
/// Makes:       a room whose angles are π/k and whose sides are those of the shape to 1e-12, for N ≤ 40 and more; every stored double is
///              the one next to the true value. Paper in S² and E² is tangential; *2222: the shorter side is 2·scale.
/// Diagnostics: those of notation::classify, notation.non-orbifold-corner, room.no-such-shape, room.bad-cuts, room.bad-lengths,
///              room.shape-needs-hyperbolic, room.unused-setting, room.bad-size, room.no-certificate (too wide for doubles).
[[nodiscard]] Result<Room> realise(const notation::Orbifold& orbifold, const scene::Shape& shape = {}, bool allow_non_orbifold = false);

}  // namespace orbc::room
