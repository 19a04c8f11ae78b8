#pragma once
#include "compiler/base/result.h"
#include "compiler/driver/product.h"

namespace orbc::driver {

/// The distances of a product from its eye: to the nearest point of its triangles and to the farthest of their corners.
struct Distances {
  double nearest = 0, farthest = 0;  ///< both 0 when there are no triangles
};
[[nodiscard]] Distances distances_from_eye(const Product& product);

/// The power of two by which to multiply a product so that renderers draw what is next to the eye. They miss surfaces nearer than small
/// lengths of their own (POV-Ray 1e-3, Blender's camera 1e-4), and cut off what lies beyond large ones (POV-Ray 1e7, Blender 1e6).
/// Makes: 1 where nothing is nearer than 1/64 or farther than 2^19. Straight rays from the eye see the same at any scale.
[[nodiscard]] double renderer_scale(const Distances& distances);

/// Multiplies the positions and lamps of a product by renderer_scale, exactly, as only exponents change. The intensity of lamps that fall
/// off with the square of the distance grows. Diagnostics: as a warning driver.eye-too-near, when no scale suits both the nearest and the
/// farthest surface.
[[nodiscard]] Diagnostics scale_for_renderers(Product& product);

}  // namespace orbc::driver
