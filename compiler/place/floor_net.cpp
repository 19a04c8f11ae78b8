// Axial coordinates have geodesic grid lines: u = i·cell is the line cosκ(u)·x − sinκ(u)·w = 0, and the lines of one family do not meet
// inside the room (on S² they meet at the poles on the border w = 0). So each cut splits only what lies beyond the one before.
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

// The grid lines strictly between the extremes of one axial coordinate.
struct Family {
  int first = 1, last = 0;
};

Family family(double low, double high, double cell) {
  return {static_cast<int>(std::floor(low / cell)) + 1, static_cast<int>(std::ceil(high / cell)) - 1};
}

Line grid_line(Space space, double c, bool along_y) {
  const double k = geometry::cos_k(space, c), s = geometry::sin_k(space, c);
  return along_y ? Line{-s, 0, k} : Line{-s, k, 0};
}

void take(std::vector<Net::Piece>& all, std::vector<Net::Piece>&& more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

// Cuts by one family; adds the index of the slab to each piece's tag. Makes: whether at most so many pieces came of it.
bool cut_into_slabs(Space space, Net& net, const Family& lines, double cell, bool along_y, std::size_t max_pieces) {
  std::vector<Net::Piece> done, rest = std::move(net.pieces);
  for (int i = lines.first; i <= lines.last; ++i) {
    const int side = -2 - 2 * (i - lines.first) - (along_y ? 1 : 0);
    Halves halves = cut(space, net, rest, grid_line(space, i * cell, along_y), side);
    for (Net::Piece& piece : halves.right) piece.tag += i - 1;
    take(done, std::move(halves.right));
    rest = std::move(halves.left);
    if (done.size() + rest.size() > max_pieces) return false;
  }
  const int top = lines.last >= lines.first ? lines.last : static_cast<int>(lines.first) - 1;
  for (Net::Piece& piece : rest) piece.tag += top;
  take(done, std::move(rest));
  net.pieces = std::move(done);
  return true;
}

// A straight cut through a half sphere has antipodal ends, and where one could cut their edge is anybody's guess. So the floor is first
// halved along v = 0 with the centre as a vertex of the cut; from then on no edge is longer than a quarter.
void halve_at_centre(Net& net) {
  Halves halves = cut(Space::spherical, net, net.pieces, grid_line(Space::spherical, 0, true), -1);
  net.pieces = std::move(halves.left);
  take(net.pieces, std::move(halves.right));
  const auto centre = static_cast<std::uint32_t>(net.vertices.size());
  net.vertices.push_back({geometry::Point{}, 0});
  for (Net::Piece& piece : net.pieces) {
    const auto along = std::find_if(piece.loop.begin(), piece.loop.end(), [](const Net::Edge& e) { return e.side == -1; });
    piece.loop.insert(along + 1, {centre, -1});
  }
}

}  // namespace

Result<Net> floor_net(const room::Room& room, double cell, std::size_t max_cells) {
  Net net;
  Net::Piece whole;
  double low[2] = {0, 0}, high[2] = {0, 0};
  for (std::size_t i = 0; i < room.outline.size(); ++i) {
    net.vertices.push_back({room.outline[i], 0});
    whole.loop.push_back({static_cast<std::uint32_t>(i), room.outline_wall[i]});
    const std::complex<double> uv = geometry::axial_from_point(room.space, room.outline[i]);
    low[0] = std::fmin(low[0], uv.real()), high[0] = std::fmax(high[0], uv.real());
    low[1] = std::fmin(low[1], uv.imag()), high[1] = std::fmax(high[1], uv.imag());
  }
  net.pieces.push_back(std::move(whole));
  if (cell == 0) return net;
  // Of the box around a narrow room little belongs to it: the pieces are counted, the box only bounds the work.
  constexpr double kMostOfBox = 128;
  const double u_cells = (high[0] - low[0]) / cell + 2, v_cells = (high[1] - low[1]) / cell + 2;
  const auto cut_all = [&] {
    if (room.space == Space::spherical) halve_at_centre(net);
    return cut_into_slabs(room.space, net, family(low[0], high[0], cell), cell, false, max_cells) &&
           cut_into_slabs(room.space, net, family(low[1], high[1], cell), cell, true, max_cells);
  };
  if (!(cell > 0) || !(u_cells * v_cells <= kMostOfBox * static_cast<double>(max_cells)) || !cut_all())
    return make_error(
        "place.too-many-cells", fmt::format("cells of {:.4g} cut this floor into more than {} pieces", cell, max_cells),
        fmt::format("a cell of {:.2g} fits", 1.3 * std::sqrt((high[0] - low[0]) * (high[1] - low[1]) / static_cast<double>(max_cells))));
  for (Net::Piece& piece : net.pieces) piece.tag &= 1;
  return net;
}

}  // namespace orbc::place
