#pragma once
#include <array>

#include "compiler/scene/scene.h"
#include "compiler/trace/follow.h"

namespace orbc::surface {

/// A rough surface as GGX facets (Walter et al., Microfacet Models for Refraction through Rough Surfaces, 2007): α = roughness².
[[nodiscard]] double facet_width(const scene::Material& material);
/// Whether a metal is so smooth that it mirrors as a mirror does, lamps and all; rougher ones show lamps as highlights.
[[nodiscard]] bool polished(const scene::Material& material);
/// How many facets, by projected area, have a normal that leans by this cosine, per solid angle. In: α².
[[nodiscard]] double facet_density(double cosine, double a2);
/// The share of facets that is seen, or lit, from a direction with this cosine to the normal: Smith's shadowing.
[[nodiscard]] double facets_seen(double cosine, double a2);

/// What facets reflect of light that meets them with this cosine: Schlick's Fresnel term. In: the reflectance face on.
[[nodiscard]] scene::Color reflectance(const scene::Color& face_on, double cosine);
/// That of a glossy or metal surface of a colour, face on.
[[nodiscard]] scene::Color face_on(const scene::Material& material, const scene::Color& albedo);

/// What light that meets several facets adds to that of one: a factor.
/// Error:  of a white metal nothing is lost; of others the share of the first facet stands for those of the next.
/// Source: Turquin, Practical multiple scattering compensation for microfacet models (2019). In: cosine of the eye to the normal.
[[nodiscard]] scene::Color by_several_facets(const scene::Color& face_on, double cosine, double alpha);

/// A way on which the room is seen in a rough mirror.
struct Glance {
  trace::Direction direction;  ///< unit, away from the surface
  double cosine = 0;           ///< to the facet that mirrors it
  double weight = 0;           ///< shadowing; 0: into the surface
};
/// The k-th of n pairs of numbers for `glance`: of the first, second or third metal on a way.
/// Makes: for the first metal pairs of facets that lean opposite ways, so that any even number of them from an even one on looks about the
///        mirrored way; those of every beginning lie in layers (van der Corput's sequence), turned by the golden section.
[[nodiscard]] std::array<double, 2> facet_numbers(int k, int n, int metal);
/// In:    a point with the normal that is to mirror; numbers in [0, 1).
/// Makes: the mean over the numbers of weight · reflectance · radiance is what the surface shows of the room.
/// Source: Heitz, Sampling the GGX Distribution of Visible Normals (JCGT 2018).
[[nodiscard]] Glance glance(geometry::Space space, const trace::SurfacePoint& point, double alpha, const std::array<double, 2>& u);

}  // namespace orbc::surface
