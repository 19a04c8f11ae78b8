#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compiler/cover/copy.h"
#include "compiler/mesh/mesh.h"
#include "compiler/place/eye.h"
#include "compiler/room/room.h"
#include "compiler/scene/color.h"

namespace orbc::driver {

/// One bent copy: its piece of the product's arrays, and what it is.
struct DrawnCopy {
  std::size_t first_vertex = 0, vertex_count = 0;
  std::size_t first_index = 0, index_count = 0;
  scene::Color tint{1, 1, 1};       ///< linear weight
  cover::Word word;
  int bounces = 0, sheet = 0;
  bool reversing = false;
  double distance = 0;              ///< from the eye to the centre of the copy, horizontal
  int storey = 0;                   ///< mirrors on floor and ceiling: how many storeys up or down
  int level = 0;                    ///< coarsest level of detail among its parts; 0 = all of it
  std::optional<cover::Wedge> wedge;  ///< the bearings in which it is seen, if not all of it is
};

/// All that an exporter may know: dense meshes in eye coordinates (z up, right-handed), one atlas, one camera.
struct Product {
  std::string title;                ///< "*22222", for comments and names
  place::Eye eye;
  scene::Color background;
  mesh::Image atlas;                ///< sRGB, rows from top to bottom
  bool blended_atlas = false;       ///< its texels are points of a smooth picture (baked light): to be looked up bilinearly
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 2>> uv;      ///< into the atlas, v from top to bottom (glTF)
  std::vector<std::uint32_t> indices;        ///< absolute, three a triangle
  std::vector<DrawnCopy> copies;
  bool flat_view = false;           ///< `--view disk`: the eye stands in chart coordinates
};

/// A picture of the tiling, for the SVG exporter: no eye, no bending.
struct Tiling {
  std::string title;
  room::Room room;
  std::vector<cover::Copy> copies;
  enum class Model { disk, klein, plane } model = Model::disk;
  enum class Colouring { parity, length } colouring = Colouring::parity;
  geometry::Isometry room_from_eye{};  ///< of the eye from which wedges are seen
};

/// A file to be written: exporters return these and touch no disk.
struct File {
  std::string name;                 ///< relative to the main output ("" = the main output itself)
  std::string bytes;
};

}  // namespace orbc::driver
