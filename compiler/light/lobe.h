#pragma once
#include <array>

#include "compiler/light/shade.h"

namespace orbc::light {

/// A rough surface as GGX facets (Walter et al., Microfacet Models for Refraction through Rough Surfaces, 2007): α = roughness².
[[nodiscard]] double facet_width(const scene::Material& material);
/// How many facets, by projected area, have a normal that leans by this cosine, per solid angle. In: α².
[[nodiscard]] double facet_density(double cosine, double a2);
/// The share of facets that is seen, or lit, from a direction with this cosine to the normal: Smith's shadowing.
[[nodiscard]] double facets_seen(double cosine, double a2);

/// What facets reflect of light that meets them with this cosine: Schlick's Fresnel term. In: the reflectance face on.
[[nodiscard]] scene::Color reflectance(const scene::Color& face_on, double cosine);
/// That of a glossy or metal surface of a colour, face on.
[[nodiscard]] scene::Color face_on(const scene::Material& material, const scene::Color& albedo);

/// A way on which the room is seen in a rough mirror.
struct Glance {
  trace::Direction direction;       ///< unit, away from the surface
  double cosine = 0;                ///< to the facet that mirrors it
  double weight = 0;                ///< shadowing; 0: into the surface
};
/// In:    a point with the normal that is to mirror; numbers in [0, 1).
/// Makes: the mean over the numbers of weight · reflectance · radiance is what the surface shows of the room.
/// Source: Heitz, Sampling the GGX Distribution of Visible Normals (JCGT 2018).
[[nodiscard]] Glance glance(geometry::Space space, const trace::SurfacePoint& point, double alpha, const std::array<double, 2>& u);

}  // namespace orbc::light
