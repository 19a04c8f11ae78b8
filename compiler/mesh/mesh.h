#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "compiler/geometry/point.h"
#include "compiler/image/image.h"

namespace orbc::mesh {

using Triangle = std::array<std::uint32_t, 3>;

/// A triangle mesh as it comes from a file or a formula: Euclidean, z up, counter-clockwise seen from outside.
struct Mesh {
  std::vector<geometry::Vector3> positions;
  std::vector<std::array<float, 2>> uv;  ///< per vertex (v from top to bottom as in glTF), or empty
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> material;            ///< per triangle index into `looks`, or empty = 0
  struct Look {                                  ///< what the file says its surface looks like
    std::array<double, 3> color{0.8, 0.8, 0.8};  ///< linear
    int texture = -1;                            ///< index into `textures`
    double cutoff = -1;                          ///< texels of less alpha (0…1) than this are holes; < 0: there are none
  };
  std::vector<Look> looks;  ///< empty when the file has no materials
  std::vector<image::Image> textures;
};

}  // namespace orbc::mesh
