#pragma once
#include <array>
#include <vector>

#include "compiler/base/result.h"
#include "compiler/place/placed.h"

namespace orbc::light {

/// One picture for the whole room, and where every vertex of every part finds its colour in it.
struct Atlas {
  mesh::Image image;                                       ///< sRGB, rows from top to bottom
  place::PlacedRoom room;                                  ///< the room with vertices split where triangles of different looks met
  std::vector<std::vector<std::array<float, 2>>> uv;       ///< per part, per vertex; v from top to bottom
};

}  // namespace orbc::light
