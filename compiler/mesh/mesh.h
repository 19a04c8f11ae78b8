#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "compiler/base/diagnostic.h"
#include "compiler/geometry/point.h"
#include "compiler/image/image.h"

namespace orbc::mesh {

using Triangle = std::array<std::uint32_t, 3>;

/// A colour in linear light: red, green, blue.
using LinearColor = std::array<float, 3>;

enum class MaterialKind { matte, glossy, metal, glass, emissive };

/// What a file says that a surface looks like.
struct Material {
  MaterialKind kind = MaterialKind::matte;
  std::array<double, 3> color{0.8, 0.8, 0.8};  ///< linear
  int texture = -1;                            ///< index into Mesh::textures; then `color` multiplies it
  double alpha_cutoff = -1;                    ///< texels of less alpha (0…1) than this are holes; < 0: there are none
  double roughness = 0.3;                      ///< glossy and metal, 0…1
  double index = 1.5;                          ///< refractive index of glass
  double emission = 1;                         ///< emissive: radiance = emission × color
  bool is_invisible = false;                   ///< more transparent than opaque: readers leave its triangles out
};

/// A triangle mesh as it comes from a file or a formula: Euclidean, z up, counter-clockwise seen from outside.
struct Mesh {
  std::vector<geometry::Vector3> positions;
  std::vector<std::array<float, 2>> uv;  ///< per vertex (v from top to bottom as in glTF), or empty
  std::vector<LinearColor> colors;       ///< per vertex: a factor of the material's colour; or empty
  std::vector<Triangle> triangles;
  std::vector<std::uint16_t> triangle_material;  ///< per triangle index into `materials`, or empty = 0
  std::vector<Material> materials;               ///< empty when the file has no materials
  std::vector<image::Image> textures;
};

/// A mesh and what its author should know about it.
struct LoadedMesh {
  Mesh mesh;
  Diagnostics warnings;
};

}  // namespace orbc::mesh
