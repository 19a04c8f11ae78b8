#pragma once
#include "compiler/base/result.h"
#include "compiler/room/room.h"
#include "compiler/scene/scene.h"

namespace orbc::room {

/// Realises the polygon of an orbifold in its space and certifies it.
/// In:          corners in the author's order; real-valued ones only with `allow_non_orbifold`.
/// Makes:       a room whose angles are π/k and whose sides are those of the shape to 1e-12, for N ≤ 40 and more.
/// Diagnostics: notation.bad-orbifold, room.no-such-shape (lengths that no polygon has), room.bad-cuts, room.shape-needs-hyperbolic, room.no-certificate.
[[nodiscard]] Result<Room> realise(const notation::Orbifold& orbifold, const scene::Shape& shape = {}, bool allow_non_orbifold = false);

}  // namespace orbc::room
