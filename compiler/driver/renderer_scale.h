#pragma once
#include "compiler/base/result.h"
#include "compiler/driver/product.h"

namespace orbc::driver {

/// How far a product reaches from its eye: to the nearest point of its triangles and to the farthest of their corners.
struct Distances {
  double nearest = 0, farthest = 0;   ///< both 0 when there are no triangles
};
[[nodiscard]] Distances distances_from_eye(const Product& product);

/// The power of two by which a product is to be multiplied so that renderers see what is next to the eye: they miss surfaces nearer than
/// their own small lengths (POV-Ray 1e-3, Blender's camera 1e-4), and cut off what is farther than their large ones (POV-Ray 1e7, Blender
/// 1e6). 1 where nothing is nearer than 1/64 or farther than 2^19. Straight rays from the eye see the same at any scale.
[[nodiscard]] double renderer_scale(const Distances& distances);

/// Multiplies positions, lamps and eye of a product, exactly: their mantissas stay. Light that fades with the square of the distance grows.
/// Diagnostics: driver.eye-too-near, a warning: no scale suits both what is nearest and what is farthest.
[[nodiscard]] Diagnostics scale_for_renderers(Product& product);

}  // namespace orbc::driver
