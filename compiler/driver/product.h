#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compiler/cover/copy.h"
#include "compiler/image/image.h"
#include "compiler/native_lights/native_light.h"
#include "compiler/place/camera.h"
#include "compiler/room/room.h"
#include "compiler/scene/color.h"
#include "compiler/scene/scene.h"

namespace orbc::driver {

/// One bent copy: its range of the product's arrays, and what it is.
struct ProductCopy {
  std::size_t first_vertex = 0, vertex_count = 0;
  std::size_t first_index = 0, index_count = 0;
  scene::Color weight{1, 1, 1};  ///< linear: the product of the mirrors on its path
  cover::Word word;
  int bounces = 0, sheet = 0;
  bool reversing = false;
  double distance = 0;                ///< from the eye to the centre of the copy, horizontal
  int storey = 0;                     ///< rooms with mirrors on floor and ceiling: storeys above (or, negative, below) the room
  int level = 0;                      ///< coarsest level of detail among its parts; 0 = full detail
  std::optional<cover::Wedge> wedge;  ///< the bearings in which it is seen; nothing: all of them
  native_lights::Shading shading = native_lights::Shading::lit;
  /// Products by object: the object of these triangles, an index into Product::objects
  std::optional<std::size_t> object = std::nullopt;
  /// The earlier entry for the same copy: of another object, or of what its weight dims. Light above white is dimmed in the atlas already,
  /// and its triangles are an entry with the weight 1
  std::optional<std::size_t> duplicate_of = std::nullopt;
};

/// Whether reports list an entry: each copy of the room is listed once.
[[nodiscard]] inline bool is_listed(const ProductCopy& copy) { return copy.shading == native_lights::Shading::lit && !copy.duplicate_of; }

/// The input of every exporter: dense meshes in eye coordinates (z up, right-handed; scene units), one atlas, one camera.
/// An exporter honours all of: masked, depth, bilinear_atlas, native, disk_view, shading of copies, scale.
struct Product {
  std::string title;  ///< the orbifold, such as "*22222"
  place::Camera eye;
  scene::Color background;                               ///< linear
  image::Image atlas;                                    ///< sRGB, 8 bits a channel, rows from top to bottom
  image::Image16 atlas16;                                ///< the same picture with 16 bits a channel; empty unless `depth` needs it
  scene::AtlasFormat depth = scene::AtlasFormat::srgb8;  ///< how exporters store the atlas
  bool masked = false;                                   ///< texels whose alpha is below one half are holes
  bool bilinear_atlas = false;                           ///< look the atlas up bilinearly: its texels are samples of baked light
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 2>> uv;  ///< into the atlas, parallel to positions; v from top to bottom (glTF)
  std::vector<std::uint32_t> indices;    ///< absolute, three a triangle
  std::vector<ProductCopy> copies;
  std::vector<std::string> objects;                  ///< products by object: names in the order of their entries in `copies`; else empty
  std::optional<native_lights::NativeLight> native;  ///< nothing: the atlas holds the light
  std::vector<std::array<float, 3>> normals;         ///< with `native` only: unit, parallel to positions
  bool disk_view = false;                            ///< `--view disk`, straight rays: positions are chart coordinates × height
  double chart_scale = 1;                            ///< with `disk_view`: what the chart, but not the height, was multiplied by
  double scale = 1;  ///< power of two by which positions and lamps, not the eye, were multiplied (renderer_scale.h)
};

/// The input of the SVG exporter: copies of the room as a flat tiling. No eye, no bending.
struct Tiling {
  std::string title;
  room::Room room;
  std::vector<cover::Copy> copies;
  enum class Model { disk, klein, plane } model = Model::disk;
  enum class Coloring { parity, length } coloring = Coloring::parity;
  geometry::Isometry room_from_eye{};  ///< of the eye whose wedges the copies have
};

/// The size of a product, counted or estimated, without pictures.
struct Amount {
  std::uint64_t copies = 0, vertices = 0, triangles = 0;
  bool normals = false;  ///< whether it has normals (native lights)
};

/// A file that an exporter has made. Exporters touch no disk.
struct File {
  std::string name;  ///< relative to the folder of the main output; empty: the main output itself
  std::string bytes;
};

}  // namespace orbc::driver
