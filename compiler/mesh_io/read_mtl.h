#pragma once
#include <array>
#include <map>
#include <string>
#include <string_view>

#include "compiler/mesh_io/polygon_soup.h"

namespace orbc::mesh_io {

/// A material of an MTL file, its pictures still by name.
struct MtlMaterial {
  std::array<double, 3> color{0.8, 0.8, 0.8};  ///< Kd, linear
  std::string texture;                         ///< map_Kd
  std::array<double, 2> uv_scale{1, 1};        ///< its option -s
  std::array<double, 2> uv_offset{0, 0};       ///< its option -o
};

using MtlLibrary = std::map<std::string, MtlMaterial>;

/// Reads an MTL file: newmtl, Kd, map_Kd with its options. Later materials of a name win.
void read_mtl(std::string_view bytes, MtlLibrary& library);

}  // namespace orbc::mesh_io
