#pragma once
#include <vector>

#include "compiler/base/result.h"
#include "compiler/place/placed.h"

namespace orbc::place {

/// A frame around a mirror, as `make_frames` needs it.
struct FrameSpec {
  int wall = 0;
  double span[2] = {0, 0}, height[2] = {0, 0};   ///< of the mirror, clipped to its wall
  double width = 0.03;
};

/// Builds the frames: along each side of the mirror half a geodesic beam of square section, half of it over the mirror, half over the wall,
/// standing out width/2 into the room, so that with its mirror image it is a whole beam. What lies at constant depth in front of a wall is
/// equidistant, not geodesic.
/// Makes: one mesh a frame, in their order (empty where nothing is left), cut off at floor, ceiling and the other walls; where frames of
///        one width meet in a corner, mitred along its bisector. Their backs and the ends on other walls are open: there they meet their
///        mirror images.
/// Error: chords of the equidistant edges miss by at most width/1000.
[[nodiscard]] std::vector<PlacedMesh> make_frames(const room::Room& room, double height, const std::vector<FrameSpec>& frames);

/// A beam of square section along the geodesic from one position to another, cut off at the walls, floor and ceiling.
/// In:    from ≠ to, both in the closed room. Error: as for frames.
/// Diagnostics: place.no-beam when the two positions are one.
[[nodiscard]] Result<PlacedMesh> make_beam(const room::Room& room, double height, const geometry::Position& from,
                                           const geometry::Position& to, double width);

/// The line that bisects corner `corner` (from 0), with the wall that ends there to its right and the wall that starts there to its left.
[[nodiscard]] geometry::Line bisector(const room::Room& room, int corner);

}  // namespace orbc::place
