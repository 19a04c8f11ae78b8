#pragma once
#include "compiler/driver/load.h"
#include "compiler/driver/product.h"
#include "compiler/render/film.h"

namespace orbc::driver {

/// The `scale` of flat rooms as they are compiled: about the size of the hyperbolic and spherical rooms for which densities and tolerances
/// are chosen.
inline constexpr double kCompiledScale = 0.65;

/// The author's unit of length in that in which a scene is compiled. Flat rooms are compiled in a unit in which they have the scale
/// `kCompiledScale`, so that the author's unit changes neither the picture nor the time that it takes. S² and H² have a unit of their own,
/// the radius of curvature: 1.
[[nodiscard]] double unit_of_length(const scene::Scene& scene);

/// A flat scene in the unit in which it is compiled. In: the author's unit in that one.
/// Formula: powers of lamps × unit², as irradiance is power over area, except of lamps without falloff.
/// Error: lengths and powers are rounded to 40 binary digits.
[[nodiscard]] scene::Scene in_compiled_unit(scene::Scene scene, double unit);

/// What was made of such a scene, in the author's unit again. In: the author's unit in that of the scene.
[[nodiscard]] Product in_author_unit(Product product, double unit);
[[nodiscard]] Tiling in_author_unit(Tiling tiling, double unit);
[[nodiscard]] render::Film in_author_unit(render::Film film, double unit);

}  // namespace orbc::driver
