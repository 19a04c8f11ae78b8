#pragma once
#include "compiler/room/polygon.h"
#include "compiler/room/room.h"

namespace orbc::room {

/// Rounds a centred polygon to the doubles of a room: every stored number is the one next to the true value. No certificate yet.
[[nodiscard]] Room settle(const Polygon& polygon, const std::vector<CornerAngle>& angles);

/// The room as realise makes it, measured but not yet judged: its certificate may say that doubles do not carry it.
[[nodiscard]] Result<Room> measured_room(const notation::Orbifold& orbifold, const scene::Shape& shape, bool allow_non_orbifold);

/// `*`: the half sphere around the origin; its one wall is the equator, which starts at +x.
[[nodiscard]] Room hemisphere();

}  // namespace orbc::room
