#pragma once
#include <vector>

#include "compiler/base/result.h"
#include "compiler/cover/copy.h"
#include "compiler/light/lamp_image.h"
#include "compiler/native_lights/native_light.h"
#include "compiler/place/camera.h"
#include "compiler/place/interior.h"

namespace orbc::native_lights {

/// The most lamps that a product may have.
inline constexpr std::size_t kMaxNativeLamps = 20'000;

/// A lit scene as one eye sees it.
struct LampScene {
  const scene::Scene& scene;
  const place::Interior& interior;
  const place::Camera& eye;
  const std::vector<light::PlacedLamp>& lamps;
  const std::vector<light::LampImage>& images;  ///< of the lamps, over `bake.mirrors` mirrors
};

struct NativeLights {
  NativeLight light;
  Diagnostics warnings;
};

/// Gives every lit copy its lamps: the images from which the lamps of the room light it over `bake.mirrors` mirrors, with their weights.
/// In:          copies as the product has them; `lit_copies`: indices of those with Shading::lit that repeat no other.
/// Exact:       in E² with equal mirrors, for point, sphere, disk, rectangle and spot, if the renderer lights each copy with its own lamps
///              only and lets everything cast shadows. Elsewhere lamps stand where the eye sees them.
/// Diagnostics: driver.too-many-lamps; as a warning driver.native-lights-approximate.
[[nodiscard]] Result<NativeLights> place_native_lights(const LampScene& lit, const std::vector<cover::Copy>& copies,
                                                       const std::vector<std::size_t>& lit_copies);

}  // namespace orbc::native_lights
