#pragma once
#include <vector>

#include "compiler/base/result.h"
#include "compiler/place/placed.h"

namespace orbc::cover {

/// The border of a room as beams meet it: the outline, cut where mirrors begin and end.
struct Rim {
  /// From points[i] to points[i+1] (cyclic), seen from inside under less than half a turn.
  struct Edge {
    int wall = 0;
    int opening = -1;               ///< index into `losses` of the mirror here, or −1: nothing goes on
  };
  std::vector<geometry::Point> points;  ///< counter-clockwise
  std::vector<Edge> edges;              ///< those of one wall follow each other
  std::vector<int> first, count;        ///< per wall: its edges
  std::vector<scene::Color> losses;     ///< reflectance × tint, each once
};

/// Makes:       edges by arc length along their walls; mirror ends within 1e-9 of a wall's end are that end.
/// Diagnostics: cover.stacked-mirrors when mirrors of different reflectance or tint hang above each other: a beam that splits by height is no wedge.
[[nodiscard]] Result<Rim> make_rim(const place::PlacedRoom& room);

}  // namespace orbc::cover
