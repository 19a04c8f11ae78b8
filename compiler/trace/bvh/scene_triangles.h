#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "compiler/trace/intersect.h"

namespace orbc::trace {

/// All triangles that rays are tested against, of all parts, in one list; room coordinates.
struct SceneTriangles {
  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> corners;  ///< per triangle: indices into `vertices`, counter-clockwise
  struct Part {
    std::uint32_t first = 0;  ///< index of its first triangle
    std::int32_t part = 0;    ///< index into Interior::parts
  };
  std::vector<Part> parts;  ///< in ascending order of `first`
};

}  // namespace orbc::trace
