// Axial coordinates have geodesic grid lines: u = i·cell is the line cosκ(u)·x − sinκ(u)·w = 0, and the lines of one family do not meet
// inside the room (on S² they meet at the poles, on the boundary w = 0). So each line splits only polygons beyond the line before it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "compiler/geometry/chart.h"
#include "compiler/place/panels.h"

namespace orbc::place {
namespace {

using geometry::Line;
using geometry::Space;

// Indices of the grid lines strictly between the extremes of one axial coordinate.
struct GridLines {
  int first = 1, last = 0;
};

GridLines grid_lines(double low, double high, double cell) {
  return {static_cast<int>(std::floor(low / cell)) + 1, static_cast<int>(std::ceil(high / cell)) - 1};
}

Line grid_line(Space space, double c, bool along_y) {
  const double k = geometry::cos_k(space, c), s = geometry::sin_k(space, c);
  return along_y ? Line{-s, 0, k} : Line{-s, k, 0};
}

void append(std::vector<PolygonMesh::Polygon>& all, std::vector<PolygonMesh::Polygon>&& more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

// Cuts the surface along one family of grid lines and adds the slab's index to each polygon's label. Makes: false if there are more than
// `max_pieces` polygons.
bool cut_into_slabs(Space space, PolygonMesh& surface, const GridLines& lines, double cell, bool along_y, std::size_t max_pieces) {
  std::vector<PolygonMesh::Polygon> done, rest = std::move(surface.polygons);
  for (int i = lines.first; i <= lines.last; ++i) {
    const int side = -2 - 2 * (i - lines.first) - (along_y ? 1 : 0);
    SplitResult split = split_by_line(space, surface, rest, grid_line(space, i * cell, along_y), side);
    for (PolygonMesh::Polygon& polygon : split.right) polygon.label += i - 1;
    append(done, std::move(split.right));
    rest = std::move(split.left);
    if (done.size() + rest.size() > max_pieces) return false;
  }
  const int top = lines.last >= lines.first ? lines.last : static_cast<int>(lines.first) - 1;
  for (PolygonMesh::Polygon& polygon : rest) polygon.label += top;
  append(done, std::move(rest));
  surface.polygons = std::move(done);
  return true;
}

// A straight cut through a hemisphere has antipodal ends, and an edge between antipodal points has no unique interior. So the floor is
// first split along v = 0 with the centre as a vertex; after that no edge is longer than a quarter of a great circle.
void halve_at_centre(PolygonMesh& surface) {
  SplitResult split = split_by_line(Space::spherical, surface, surface.polygons, grid_line(Space::spherical, 0, true), -1);
  surface.polygons = std::move(split.left);
  append(surface.polygons, std::move(split.right));
  const auto centre = static_cast<std::uint32_t>(surface.vertices.size());
  surface.vertices.push_back({geometry::Point{}, 0});
  for (PolygonMesh::Polygon& polygon : surface.polygons) {
    const auto along = std::find_if(polygon.loop.begin(), polygon.loop.end(), [](const PolygonMesh::Edge& e) { return e.side == -1; });
    polygon.loop.insert(along + 1, {centre, -1});
  }
}

}  // namespace

Result<PolygonMesh> floor_polygons(const room::Room& room, double cell, std::size_t max_cells) {
  PolygonMesh surface;
  PolygonMesh::Polygon whole;
  double low[2] = {0, 0}, high[2] = {0, 0};
  for (std::size_t i = 0; i < room.outline.size(); ++i) {
    surface.vertices.push_back({room.outline[i], 0});
    whole.loop.push_back({static_cast<std::uint32_t>(i), room.outline_wall[i]});
    const std::complex<double> uv = geometry::axial_from_point(room.space, room.outline[i]);
    low[0] = std::fmin(low[0], uv.real());
    low[1] = std::fmin(low[1], uv.imag());
    high[0] = std::fmax(high[0], uv.real());
    high[1] = std::fmax(high[1], uv.imag());
  }
  surface.polygons.push_back(std::move(whole));
  if (cell == 0) return surface;
  // A narrow room fills little of its bounding box. The polygons are counted; the box only bounds the work.
  constexpr double kMaxBoxCellsPerCell = 128;
  const double u_cells = (high[0] - low[0]) / cell + 2, v_cells = (high[1] - low[1]) / cell + 2;
  const auto cut_all = [&] {
    if (room.space == Space::spherical) halve_at_centre(surface);
    return cut_into_slabs(room.space, surface, grid_lines(low[0], high[0], cell), cell, false, max_cells) &&
           cut_into_slabs(room.space, surface, grid_lines(low[1], high[1], cell), cell, true, max_cells);
  };
  if (!(cell > 0) || !(u_cells * v_cells <= kMaxBoxCellsPerCell * static_cast<double>(max_cells)) || !cut_all())
    return make_error(
        "place.too-many-cells", fmt::format("cells of {:.4g} cut this floor into more than {} pieces", cell, max_cells),
        fmt::format("a cell of {:.2g} fits", 1.3 * std::sqrt((high[0] - low[0]) * (high[1] - low[1]) / static_cast<double>(max_cells))));
  for (PolygonMesh::Polygon& polygon : surface.polygons) polygon.label &= 1;
  return surface;
}

}  // namespace orbc::place
