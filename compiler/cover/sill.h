#pragma once
#include <vector>

#include "compiler/cover/wedge.h"
#include "compiler/geometry/line.h"
#include "compiler/geometry/space.h"

namespace orbc::cover {

/// A height on a wall that rays cross on their way, where mirrors above each other meet: those that pass above it see something else than
/// those below. What divides them, as the eye sees it, is the surface of all rays through the sill.
struct Sill {
  geometry::Line line;              ///< the wall's, in eye coordinates, on either side
  int sheet = 0;                    ///< S²: half turns before it is met
  double z = 0;
  bool above = false;               ///< what is seen lies above it; else below
};

/// Arc length from the eye to the sill in the direction of a bearing that meets it.
/// Formula: ℓ_w cosκ s + sinκ s (ℓ_x x + ℓ_y y) = 0.
/// Error:   H²: grows like e^(2s) ulp; bearings that miss the line, but for rounding, get a large length.
[[nodiscard]] double distance_to(geometry::Space space, const Sill& sill, const Bearing& bearing);

/// Rise over run of the ray to the sill: (z − eye_z) / distance.
[[nodiscard]] inline double slope_of(geometry::Space space, const Sill& sill, const Bearing& bearing, double eye_z) {
  return (sill.z - eye_z) / distance_to(space, sill, bearing);
}

/// Bearings of the wedge, evenly spaced from border to border.
[[nodiscard]] std::vector<Bearing> spread(const Wedge& wedge, int count);

/// Takes a sill into those that bound a bundle of rays, later ones crossed farther out, and drops those that bound nothing any more.
/// Exact:  what is dropped bounds nothing for any bearing, since slopes through one height fall with the distance.
void narrow(std::vector<Sill>& sills, const Sill& next, double eye_z);

/// Whether no ray of the wedge passes all sills and crosses `line` at heights low … high. Measured at some bearings, with a margin: true is
/// true.
[[nodiscard]] bool nothing_passes(geometry::Space space, const std::vector<Sill>& sills, const Sill& low, const Sill& high,
                                  const Wedge& wedge, double eye_z);

}  // namespace orbc::cover
