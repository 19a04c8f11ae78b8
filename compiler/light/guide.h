#pragma once
#include <array>
#include <vector>

#include "compiler/light/lighting.h"
#include "compiler/surface/tangent_frame.h"

namespace orbc::light {

/// The hot spots of a lamp: below and above it, and beside it on plain walls.
[[nodiscard]] std::vector<HotSpot> find_hot_spots(const PlacedLamp& lamp, const place::Interior& interior);

/// A density of directions for sampling the light that comes to a matte point from all other surfaces. It mixes the cosine density with
/// cones towards the hot spots of lamps and of their images in mirrors. Where light really comes from has no influence on it: the mean of
/// weight × radiance is ∫ radiance·cosθ dω/π whatever the cones are.
/// Source: Veach, Robust Monte Carlo methods (1997), §9.2, the one-sample mixture.
struct Guide {
  static constexpr int kMaxLobes = 24;
  /// A cone with constant density.
  struct Lobe {
    geometry::Vector3 axis;  ///< unit
    double cosine = 1;       ///< of half the opening angle
    double probability = 0;  ///< of a direction from this lobe
    double density = 0;      ///< probability / solid angle
  };
  std::array<Lobe, kMaxLobes> lobes;
  int count = 0;                  ///< lobes in use
  double cosine_probability = 1;  ///< of a direction from the cosine density
  surface::TangentFrame frame;
  geometry::Vector3 normal, tangent, bitangent;  ///< orthonormal, in `frame`
  geometry::Vector3 geometric_normal;            ///< no direction goes below its plane
};
[[nodiscard]] Guide guide_at(const LightingContext& lighting, const surface::ShadingPoint& point);

/// A direction sampled by a guide.
struct DirectionSample {
  trace::Direction direction;  ///< unit
  double weight = 0;           ///< cosθ/(π·density); 0: below the surface
};
/// In: numbers u in [0, 1).
[[nodiscard]] DirectionSample sample_direction(const Guide& guide, const std::array<double, 3>& u);

}  // namespace orbc::light
