#pragma once
#include <vector>

#include "compiler/cover/wedge.h"
#include "compiler/geometry/line.h"
#include "compiler/geometry/space.h"

namespace orbc::cover {

/// A horizontal line on a wall that separates two mirrors above each other. Rays that pass above it reach another copy than rays that pass
/// below it. The eye sees the separation as the surface of all rays through this line.
struct HeightBound {
  geometry::Line line;  ///< the wall, in eye coordinates, with either orientation
  int sheet = 0;        ///< S²: half turns before the ray meets the wall (copy.h)
  double z = 0;         ///< height of the line
  bool above = false;   ///< whether rays must pass above it; otherwise below
};

/// Arc length on the floor from the eye to the wall of a bound, in the direction of a bearing that meets it.
/// Formula: ℓ_w cosκ s + sinκ s (ℓ_x x + ℓ_y y) = 0.
/// Error:   H²: grows like e^(2s) ulp. A bearing that misses the wall by rounding gets a large length.
[[nodiscard]] double distance_to(geometry::Space space, const HeightBound& bound, const Bearing& bearing);

/// Rise over run of the ray from the eye to a bound: (z − eye_z) / distance_to(…).
[[nodiscard]] inline double slope_of(geometry::Space space, const HeightBound& bound, const Bearing& bearing, double eye_z) {
  return (bound.z - eye_z) / distance_to(space, bound, bearing);
}

/// `count` ≥ 2 bearings of a wedge, evenly spaced; the first and the last are its borders.
[[nodiscard]] std::vector<Bearing> sample_bearings(const Wedge& wedge, int count);

/// The bounds of a bundle of rays after one more bound. Bounds that another one implies are left out.
/// In:    rays meet the walls of `bounds` in their order, and the wall of `next` after them.
/// Exact: a bound is left out only where it is implied for every bearing: slopes through one height fall with the distance.
[[nodiscard]] std::vector<HeightBound> with_bound(std::vector<HeightBound> bounds, const HeightBound& next, double eye_z);

/// The part of a wall between two heights.
struct HeightRange {
  HeightBound low, high;
};

/// Whether no ray of the wedge respects all bounds and meets the wall within the range.
/// Error: measured at 33 bearings, with a margin for those between: true is always right, false may be wrong for very thin bundles.
[[nodiscard]] bool is_blocked(geometry::Space space, const std::vector<HeightBound>& bounds, const HeightRange& range, const Wedge& wedge,
                              double eye_z);

}  // namespace orbc::cover
