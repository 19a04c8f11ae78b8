#pragma once
#include "compiler/light/random.h"
#include "compiler/render/draw.h"

namespace orbc::render {

/// Light that comes to a matte point from all other surfaces of the room: the guess of a few paths of ∫ radiance·cosθ dω/π.
/// Makes: a walk from surface to surface. Directions by light::Guide in the product metric's tangent frame; each leg is a geodesic through
///        the real mirrors, and on through mirror and glass objects; each matte surface shows what its lamps give it (a guess by one shadow
///        ray: the bodies of lamps are not there, so nothing counts twice) and ambient light; each emissive one its light. Ends after
///        `field.options.passes` surfaces, by Russian roulette, or at a cut-off mirror, which shows the background.
/// In:    how many paths; their first directions are spread by a lattice, moved at random, so that more are better than as many guesses.
/// Exact: its mean over random numbers is the light asked for, but for: caustics (light of lamps by mirror and glass objects), and
///        highlights, which only eyes see.
[[nodiscard]] scene::Color passed_on(const place::PlacedRoom& room, const light::LightField& field, const light::LightPoint& from,
                                     light::Random& random, int paths = 1);

/// What the noise of a path-traced film amounts to in its picture: root mean square over all pixels of the stated standard error, in steps
/// of 1/255. 0 without noise.
[[nodiscard]] double noise_of(const Film& film, double exposure);

}  // namespace orbc::render
