#pragma once
#include "compiler/room/room.h"

namespace orbc::room {

/// The direction, from the centre, in which a picture tells most of the room: a little beside a corner, so that the images around it are
/// seen in full and the wall beside it shows those behind; of the corners the one that is second widest, since around sharp ones the images
/// are many and far. The strip is seen along its row of images, the half sphere anyhow.
/// Makes: degrees counter-clockwise from corner 1, in [0, 360).
[[nodiscard]] double view_direction(const Room& room);

}  // namespace orbc::room
