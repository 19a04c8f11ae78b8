#pragma once
#include <array>

#include "compiler/scene/scene.h"
#include "compiler/trace/follow.h"

/// Rough surfaces as GGX microfacets.
/// Source: Walter, Marschner, Li, Torrance, Microfacet models for refraction through rough surfaces (2007).
namespace orbc::surface {

/// α of a material: roughness², at least 0.002.
[[nodiscard]] double ggx_alpha(const scene::Material& material);
/// Whether a metal is so smooth that it is drawn as a perfect mirror, which shows lamps too. Rougher metals show lamps as highlights.
[[nodiscard]] bool is_specular_metal(const scene::Material& material);

/// The distribution D of microfacet normals, per solid angle. In: cosine of the half vector to the normal; α².
[[nodiscard]] double ggx_d(double cosine, double a2);
/// Smith's masking function G₁: the visible share of microfacets. In: cosine of the direction to the normal, > 0; α².
[[nodiscard]] double smith_g1(double cosine, double a2);
/// Schlick's approximation of the Fresnel reflectance. In: the reflectance at normal incidence; cosine of the angle of incidence.
[[nodiscard]] scene::Color fresnel_schlick(const scene::Color& f0, double cosine);
/// The reflectance at normal incidence: the albedo of metals, ((n−1)/(n+1))² of others.
[[nodiscard]] scene::Color f0(const scene::Material& material, const scene::Color& albedo);

/// The factor by which light scattered several times between microfacets raises that scattered once.
/// In:     cosine of the direction to the eye to the normal.
/// Error:  a white metal loses no energy; for others the colour of the first reflection stands for that of the next ones.
/// Source: Turquin, Practical multiple scattering compensation for microfacet models (2019).
[[nodiscard]] scene::Color multiscatter_compensation(const scene::Color& f0, double cosine, double alpha);

/// A direction sampled in proportion to the visible microfacets.
struct BsdfSample {
  trace::Direction direction;  ///< unit, away from the surface
  double cos_half = 0;         ///< cosine of the direction to the microfacet's normal: the argument of Fresnel's term
  double weight = 0;           ///< G₁ of the direction; 0: it leads into the surface
};
/// Samples the reflection of a metal at a point, whose normal is that of the reflection.
/// In:     numbers u in [0, 1).
/// Makes:  the mean over u of weight · Fresnel · radiance is the radiance that the surface reflects towards the eye.
/// Source: Heitz, Sampling the GGX distribution of visible normals (JCGT 2018).
[[nodiscard]] BsdfSample sample_ggx(geometry::Space space, const trace::SurfacePoint& point, double alpha, const std::array<double, 2>& u);

/// Sample k of n for `sample_ggx`. In: how many metals the path has met before this one: 0, 1 or 2.
/// Makes: the first metal gets pairs of microfacets that lean to opposite sides, so the mean direction of 2m samples that begin with an
///        even one is that of a perfect mirror. Every first part of the sequence is stratified: van der Corput's sequence in u₀, the golden
///        ratio in u₁. The next two metals get lattices that are independent of it.
[[nodiscard]] std::array<double, 2> vndf_point(int k, int n, int metals_before);

}  // namespace orbc::surface
