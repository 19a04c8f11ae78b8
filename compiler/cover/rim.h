#pragma once
#include <limits>
#include <vector>

#include "compiler/place/placed.h"

namespace orbc::cover {

/// The mirrors above each other that reflect alike, as one: rays that meet the wall at heights from … to go on here, if they are not
/// stopped by plain wall.
struct Opening {
  int loss = 0;                     ///< index into Rim::losses
  double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();
};

/// The border of a room as beams meet it: the outline, cut where mirrors begin and end.
struct Rim {
  /// From points[i] to points[i+1] (cyclic), seen from inside under less than half a turn.
  struct Edge {
    int wall = 0;
    std::vector<Opening> openings;  ///< upwards; they fill all heights, divided in the middle of the plain wall between mirrors. None:
                                    ///< nothing goes on
  };
  std::vector<geometry::Point> points;  ///< counter-clockwise
  std::vector<Edge> edges;              ///< those of one wall follow each other
  std::vector<int> first, count;        ///< per wall: its edges
  std::vector<scene::Color> losses;     ///< reflectance × tint, each once
};

/// Makes:       edges by arc length along their walls; mirror ends within 1e-9 of a wall's end are that end. Where mirrors overlap the
///              first counts. With mirrors on floor and ceiling heights are those of all storeys within `max_bounces`, on top of each
///              other.
[[nodiscard]] Rim make_rim(const place::PlacedRoom& room, int max_bounces);

}  // namespace orbc::cover
