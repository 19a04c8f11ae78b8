#pragma once
#include <vector>

#include "compiler/base/result.h"
#include "compiler/place/interior.h"

namespace orbc::place {

/// A frame around a mirror, as `make_frames` needs it.
struct FrameSpec {
  int wall = 0;                                 ///< from 0
  double span[2] = {0, 0}, height[2] = {0, 0};  ///< of the mirror, clipped to its wall
  double width = 0.03;                          ///< of the square section
};

/// Makes the frames of mirrors. Along each side of a mirror lies half of a geodesic bar of square section, half of it over the mirror and
/// half over the wall. It stands out width/2 into the room, so that it and its mirror image together are a whole bar. Surfaces at constant
/// depth in front of a wall are equidistants, not geodesics.
/// Makes: one mesh per frame, in their order, empty where nothing is left. Frames are cut off at floor, ceiling and the other walls. Frames
///        of one width that meet in a corner are mitred along its bisector. The backs of frames and their ends on other walls are open,
///        because they meet their mirror images there.
/// Error: chords of the equidistant edges deviate by at most width/1000.
[[nodiscard]] std::vector<PlacedMesh> make_frames(const room::Room& room, double height, const std::vector<FrameSpec>& frames);

/// Makes a bar of square section `width` along the geodesic between two positions, cut off at walls, floor and ceiling.
/// In:          from ≠ to, both in the closed room.
/// Error:       as for frames.
/// Diagnostics: place.no-beam when the two positions are equal.
[[nodiscard]] Result<PlacedMesh> make_bar(const room::Room& room, double height, const geometry::Position& from,
                                          const geometry::Position& to, double width);

/// The line that bisects corner `corner` (from 0). The wall that ends there lies to its right, the wall that starts there to its left.
[[nodiscard]] geometry::Line bisector(const room::Room& room, int corner);

}  // namespace orbc::place
