#pragma once
#include <optional>

#include "compiler/light/lighting.h"
#include "compiler/surface/sampling.h"

namespace orbc::light {

/// A path of light, traced from the eye or from a matte surface towards the light.
struct LightPath {
  /// A surface that is neither mirror nor glass.
  struct End {
    trace::SurfacePoint point;
    trace::Hit hit;
  };
  scene::Color radiance;  ///< collected so far
  scene::Color throughput{1, 1, 1};
  std::optional<End> end;  ///< none: the path ended on an emissive surface, or was cut off
};

/// How rays are followed over the mirrors of the room.
[[nodiscard]] trace::FollowOptions path_follow_options(const LightingContext& lighting);

/// Extends a path along a ray, over the mirrors of the room and through mirror and glass objects, to the next matte surface.
/// In:    the room with its textures; the path up to the ray; random numbers that choose between reflection and transmission at glass.
/// Makes: the path with the radiance of emissive mirrors and surfaces on the way added, and that of the background where it is cut off.
[[nodiscard]] LightPath extend_path(const place::Interior& interior, const LightingContext& lighting, LightPath path, const trace::Ray& ray,
                                    surface::Random& random);
/// The same for a ray that was already followed with path_follow_options.
[[nodiscard]] LightPath extend_path(const place::Interior& interior, const LightingContext& lighting, LightPath path, trace::Path followed,
                                    surface::Random& random);

}  // namespace orbc::light
