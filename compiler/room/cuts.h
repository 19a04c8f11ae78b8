#pragma once
#include <array>
#include <vector>

#include "compiler/room/room.h"

namespace orbc::room {

/// The common perpendicular of two walls, where a decomposition cuts the room.
struct CutSegment {
  std::array<int, 2> walls{};  ///< from 0
  geometry::Point from, to;    ///< its feet on them
};

/// The cuts of the paper's forward decomposition into `*22k₃k₄` quads and `*2222k` pentagons, in a room of any shape.
/// Makes: N − 3 segments in H² with N ≥ 4 corners; none elsewhere, and none where walls have no common perpendicular inside the room.
/// Error: that of the stored lines.
[[nodiscard]] std::vector<CutSegment> cut_segments(const Room& room);

}  // namespace orbc::room
