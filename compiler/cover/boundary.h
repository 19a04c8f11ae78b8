#pragma once
#include <limits>
#include <vector>

#include "compiler/place/interior.h"

namespace orbc::cover {

/// A range of heights on a wall in which all mirrors have one throughput. A ray that meets the wall in this range continues with that
/// throughput, unless it meets plain wall.
struct Aperture {
  int throughput_index = 0;  ///< index into Boundary::throughputs
  double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();
};

/// The outline of a room, divided where mirrors begin and end.
struct Boundary {
  /// Joins points[i] and points[i+1] (cyclic). From inside the room it appears under less than half a turn.
  struct Edge {
    int wall = 0;
    std::vector<Aperture> apertures;  ///< upwards. They fill all heights: they meet halfway between two mirrors. Empty: a plain wall
  };
  std::vector<geometry::Point> points;      ///< counter-clockwise
  std::vector<Edge> edges;                  ///< parallel to points; those of one wall follow each other
  std::vector<int> first_edge, edge_count;  ///< by wall
  std::vector<scene::Color> throughputs;    ///< of the mirrors, without repetitions
};

/// Makes: the edges of a wall in the order of arc length. Mirror ends within 1e-9 of a wall's end count as this end. Where mirrors overlap,
///        the first one counts, as in the tracer. With mirrors on floor and ceiling the heights are those of all storeys within
///        `max_bounces`.
[[nodiscard]] Boundary make_boundary(const place::Interior& room, int max_bounces);

}  // namespace orbc::cover
