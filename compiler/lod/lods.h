#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "compiler/place/interior.h"

namespace orbc::lod {

/// A room with coarser levels of its heavy parts. No eye is involved: one value serves all pictures of the room.
struct InteriorWithLods {
  /// The parts of the room in their order, then the coarser levels of the first part that has any, of the second, and so on
  place::Interior interior;
  /// [part of the room][level]: index into interior.parts. Level 0 is the part itself; higher levels are coarser
  std::vector<std::vector<std::uint32_t>> part_of_level;
  /// Per part of `interior`: how far its surface lies from that of the part for which it stands, an intrinsic length; 0 for level 0.
  /// The larger of both one-sided distances, of the surfaces and of the borders of their materials
  std::vector<double> surface_offset;
};

/// How many parts the room itself has.
[[nodiscard]] inline std::size_t room_part_count(const InteriorWithLods& lods) { return lods.part_of_level.size(); }

}  // namespace orbc::lod
