#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "compiler/trace/intersect.h"

namespace orbc::trace {

/// The triangles of a scene in one list: corners as indices into `vertices`, room coordinates.
struct Soup {
  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  struct Part {
    std::uint32_t first = 0;        ///< its first triangle
    std::int32_t part = 0;          ///< index into PlacedRoom::parts
  };
  std::vector<Part> parts;          ///< in order
};

}  // namespace orbc::trace
