#pragma once
#include "compiler/room/room.h"

namespace orbc::room {

/// A good viewing direction from the centre of a room: 20° to the right of the corner that is second widest, so that the picture shows all
/// images around this corner and those behind the wall beside it. Around sharp corners images are many and far away. In a strip the
/// direction is along its row of images; in the half sphere it is 0.
/// Makes: degrees counter-clockwise from corner 1, in [0, 360).
[[nodiscard]] double view_direction(const Room& room);

}  // namespace orbc::room
