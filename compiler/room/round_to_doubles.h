#pragma once
#include "compiler/room/polygon.h"
#include "compiler/room/room.h"

namespace orbc::room {

/// The room of a centred polygon: every stored number is the double nearest to the true value.
/// Makes: no certificate, orbifold or area yet.
[[nodiscard]] Room round_to_doubles(const Polygon& polygon, const std::vector<CornerAngle>& angles);

/// Realises a room and measures its certificate, which may say that doubles do not carry the room.
/// Diagnostics: those of realise, except room.no-certificate and those of certificates that do not pass.
[[nodiscard]] Result<Room> realise_uncertified(const notation::Orbifold& orbifold, const scene::Shape& shape, bool allow_non_orbifold);

/// `*`: the half sphere around the origin; its one wall is the equator, which starts at +x.
[[nodiscard]] Room hemisphere();

}  // namespace orbc::room
