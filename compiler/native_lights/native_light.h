#pragma once
#include <cstddef>
#include <vector>

#include "compiler/geometry/isometry.h"
#include "compiler/scene/color.h"
#include "compiler/scene/scene.h"

namespace orbc::native_lights {

/// How the triangles of a copy get their light. Products without native lights know `lit` alone.
enum class Shading {
  lit,        ///< from the atlas or, in products with native lights, from the lamps
  emissive,   ///< from the atlas; native lights add nothing
  lamp_body,  ///< like `emissive`; besides, the triangles cast no shadow
};

/// An image of a lamp in eye coordinates. It lights one copy.
struct NativeLamp {
  std::size_t copy = 0;  ///< the copy that it lights: an index into Product::copies
  bool direct = true;    ///< the lamp of that copy itself; false: the image of a lamp in mirrors
  scene::LampKind kind = scene::LampKind::point;
  bool inverse_square = true;  ///< whether its light falls off with the square of the distance
  geometry::Vector3 at;
  geometry::Vector3 axis{0, 0, -1};  ///< unit; the direction it faces, of a tube the direction along it
  geometry::Vector3 half_u, half_v;  ///< half the sides of a rectangle, radii of a disk or sphere; of a tube half_u is half its length
  double cone_inner = -1, cone_outer = -1;  ///< spot: cosines of the angles between which its light falls to 0
  /// A white surface that faces the lamp at distance r shows intensity/r². Includes the weight of the path and the exposure
  scene::Color intensity;
};

/// Light that the renderer computes: copies with Shading::lit get it instead of the light in the atlas.
struct NativeLight {
  scene::Color ambient;           ///< includes the exposure
  std::vector<NativeLamp> lamps;  ///< in the order of the copies
};

}  // namespace orbc::native_lights
