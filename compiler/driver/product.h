#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compiler/cover/copy.h"
#include "compiler/image/image.h"
#include "compiler/mesh/mesh.h"
#include "compiler/place/camera.h"
#include "compiler/room/room.h"
#include "compiler/scene/color.h"
#include "compiler/scene/scene.h"

namespace orbc::driver {

/// How a copy's triangles shine. Only products with lamps know others than `lit`.
enum class Shine {
  lit,      ///< by what light there is: the atlas', or that of lamps
  glowing,  ///< the atlas holds their light, lamps add nothing
  lamp,     ///< the same, and they cast no shadow: bodies of lamps
};

/// One bent copy: its piece of the product's arrays, and what it is.
struct DrawnCopy {
  std::size_t first_vertex = 0, vertex_count = 0;
  std::size_t first_index = 0, index_count = 0;
  scene::Color tint{1, 1, 1};  ///< linear weight
  cover::Word word;
  int bounces = 0, sheet = 0;
  bool reversing = false;
  double distance = 0;                ///< from the eye to the centre of the copy, horizontal
  int storey = 0;                     ///< mirrors on floor and ceiling: how many storeys up or down
  int level = 0;                      ///< coarsest level of detail among its parts; 0 = all of it
  std::optional<cover::Wedge> wedge;  ///< the bearings in which it is seen, if not all of it is
  Shine shine = Shine::lit;
  std::optional<std::size_t> object = std::nullopt;    ///< by object: whose triangles these are, an index into Product::objects
  std::optional<std::size_t> again_of = std::nullopt;  ///< by object: the earlier entry, of another object, that stands for the same copy
};

/// Whether a report lists it: what glows is listed with its room, and a copy once, whatever objects it is parted into.
[[nodiscard]] inline bool is_listed(const DrawnCopy& copy) { return copy.shine == Shine::lit && !copy.again_of; }

/// An image of a lamp in eye coordinates, for the renderer to light one copy with.
struct NativeLamp {
  std::size_t copy = 0;  ///< index into Product::copies: what it lights
  bool own = true;       ///< it hangs in that copy; false: it is its image in mirrors
  scene::LampKind kind = scene::LampKind::point;
  bool fades = true;                        ///< by the square of the distance
  geometry::Vector3 at, axis{0, 0, -1};     ///< axis: unit, where it shines to (tube: along it)
  geometry::Vector3 across, other;          ///< half the extent of a disk, rectangle, sphere; of a tube `across` is half its length
  double cone_inner = -1, cone_outer = -1;  ///< spot: cosines between which it fades out
  scene::Color intensity;  ///< so that a white surface face on at distance r shows intensity/r²; weights and exposure are in it
};
/// The renderer's own light: what copies with Shine::lit get instead of light in the atlas.
struct NativeLight {
  scene::Color ambient;           ///< exposure is in it
  std::vector<NativeLamp> lamps;  ///< in the order of the copies
};

/// All that an exporter may know: dense meshes in eye coordinates (z up, right-handed), one atlas, one camera.
struct Product {
  std::string title;  ///< "*22222", for comments and names
  place::Camera eye;
  scene::Color background;
  image::Image atlas;                                  ///< sRGB, rows from top to bottom
  image::Image16 atlas16;                              ///< the same with 16 bits a channel; empty unless asked for
  scene::AtlasFormat depth = scene::AtlasFormat::srgb8;  ///< what exporters are to write of it
  bool masked = false;                                 ///< texels of the atlas whose alpha is below one half are holes in what they cover
  bool blended_atlas = false;  ///< its texels are points of a smooth picture (baked light): to be looked up bilinearly
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 2>> uv;  ///< into the atlas, v from top to bottom (glTF)
  std::vector<std::uint32_t> indices;    ///< absolute, three a triangle
  std::vector<DrawnCopy> copies;
  std::vector<std::string> objects;           ///< by object: names, in the order in which their copies follow one another; else empty
  std::optional<NativeLight> native;          ///< nothing: the atlas holds the light
  std::vector<std::array<float, 3>> normals;  ///< with `native` only: unit, parallel to positions
  bool flat_view = false;                     ///< `--view disk`: the eye stands in chart coordinates
  double scale = 1;  ///< a power of two by which positions and lamps are multiplied (renderer_scale.h); the eye is not
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

/// How much there is to be written, without pictures: also of a product that is only foreseen.
struct Amount {
  std::uint64_t copies = 0, vertices = 0, triangles = 0;
  bool normals = false;  ///< with lamps of the renderer's own
};

/// A file to be written: exporters return these and touch no disk.
struct File {
  std::string name;  ///< relative to the main output ("" = the main output itself)
  std::string bytes;
};

}  // namespace orbc::driver
