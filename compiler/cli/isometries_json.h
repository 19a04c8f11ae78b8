#pragma once
#include <string>
#include <vector>

#include "compiler/cover/copy.h"
#include "compiler/room/room.h"

namespace orbc::cli {

/// A point as {"disk": [x, y], "ambient": [w, x, y]}.
[[nodiscard]] std::string corner_json(geometry::Space space, const geometry::Point& p);

/// The first copies of an orbifold's room: by word length, then as the ShortLex order has them; the room itself is one.
[[nodiscard]] std::vector<cover::Copy> first_copies(const room::Room& room, int count);

/// A copy with its word and its isometry, cover from room: as the Möbius map z ↦ (az + b)/(cz + d) of the disk chart, of z̄ if "reversing",
/// and as the 3×3 matrix of ambient vectors (w, x, y), row by row.
[[nodiscard]] std::string copy_json(const cover::Copy& copy);

}  // namespace orbc::cli
