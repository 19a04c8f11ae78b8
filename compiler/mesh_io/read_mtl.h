#pragma once
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "compiler/mesh_io/texture_loader.h"
#include "compiler/mesh_io/wrap_modes.h"

namespace orbc::mesh_io {

/// A picture that an MTL file names, with its options.
struct MtlMap {
  std::string file;                    ///< empty: there is none
  std::array<double, 2> scale{1, 1};   ///< -s
  std::array<double, 2> offset{0, 0};  ///< -o
  bool is_clamped = false;             ///< -clamp on
};

/// A material of an MTL file.
struct MtlMaterial {
  std::array<double, 3> color{0.8, 0.8, 0.8};  ///< Kd, linear
  std::array<double, 3> emission{0, 0, 0};     ///< Ke, linear
  std::optional<double> opacity;               ///< d, else 1 − Tr
  double index = 1;                            ///< Ni
  int illumination = 2;                        ///< illum
  double metallic = 0, roughness = 0.3;        ///< Pm, Pr
  MtlMap texture, opacity_map;                 ///< map_Kd, map_d
};

struct MtlLibrary {
  std::map<std::string, MtlMaterial> materials;
  std::set<std::string> ignored;  ///< statements that change how a surface looks and are left out, in lower case
};

/// Reads an MTL file into a library. Later materials of a name replace earlier ones.
void read_mtl(std::string_view bytes, MtlLibrary& library);

/// An MTL material as a mesh has it.
struct ConvertedMaterial {
  mesh::Material material;
  WrapModes wrap;
  bool is_exact = true;  ///< nothing is blended
};

/// Loads its pictures. Ke makes an emissive material, Pm metal, a transparent one with illum 4, 6, 7 or 9 glass; map_d cuts holes.
[[nodiscard]] ConvertedMaterial convert(const MtlMaterial& material, TextureLoader& textures);

}  // namespace orbc::mesh_io
