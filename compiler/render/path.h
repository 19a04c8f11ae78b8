#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "compiler/render/draw.h"
#include "compiler/surface/random.h"

namespace orbc::render {

/// The random numbers of one sample of a pixel. Where paths begin is chosen by lattices over all samples of the pixel, moved at random:
/// several by themselves, so that their spread tells the error.
struct Chance {
  static constexpr int kGroups = 4;
  surface::Random random{0};
  std::array<double, 6> shift{0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
  int before = 0;    ///< earlier samples of the same lattice
  light::Turn turn;  ///< of the lamps: what this sample asks
  Chance() = default;
  Chance(std::uint64_t seed, std::uint64_t pixel, int sample, int samples);
  /// The order of a pixel's samples in which those with the same remainder, by any number, lie apart: on a grid a lattice of diagonals.
  [[nodiscard]] static light::Turn turn_of(int sample, int samples);
  [[nodiscard]] static int group_of(int sample, int samples) { return sample % std::min(samples, kGroups); }
};

/// Light that comes to a matte point from all other surfaces of the room: the guess of a few paths of ∫ radiance·cosθ dω/π.
/// Makes: a walk from surface to surface. Directions by light::Guide in the product metric's tangent frame; each leg is a geodesic through
///        the real mirrors, and on through mirror and glass objects; each matte surface shows what its lamps give it (a guess by one shadow
///        ray: the bodies of lamps are not there, so nothing counts twice) and ambient light; each emissive one its light. Ends after
///        `field.options.passes` surfaces, by Russian roulette, or at a cut-off mirror, which shows the background.
/// In:    how many paths; where they begin (the first direction, and the first sample of a lamp) is spread by a lattice.
/// Exact: its mean over random numbers is the light asked for, but for: caustics (light of lamps by mirror, glass and metal objects), and
///        highlights, which only eyes see.
[[nodiscard]] scene::Color passed_on(const place::PlacedRoom& room, const light::LightField& field, const surface::LightPoint& from,
                                     Chance& chance, int paths = 1);

/// What the noise of a path-traced film amounts to in its picture: root mean square over all pixels of the stated standard error, in steps
/// of 1/255. 0 without noise.
[[nodiscard]] double noise_of(const Film& film, double exposure);

}  // namespace orbc::render
