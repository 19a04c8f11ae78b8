#pragma once
#include "compiler/room/room.h"

namespace orbc::room {

/// Measures a realised room from its stored doubles alone, not from how it was made.
/// Exact:  `convex` (signs of 3×3 determinants of the stored vectors, no tolerance). The residuals are upper bounds by interval arithmetic
///         of 168 bits around the stored doubles, which count as exact; they contain the rounding of the stored room, nothing else.
/// Makes:  infinite residuals where the stored doubles define no angle or no distance any more.
[[nodiscard]] Certificate certify(const Room& room);

/// Whether the room is convex and its residuals are small: not more than rounding to doubles explains at this size (in H² doubles lose
/// e^(2r) at distance r), and not more than a hundredth of the sharpest angle, of the scale, or a tenth of the area's scale.
[[nodiscard]] bool passes(const Room& room, const Certificate& certificate);

}  // namespace orbc::room
