// Every panel is first cut by itself into convex pieces; then panels that meet exchange the points of their common edge (the foot of a
// wall, its head, the upright edge in a corner), and only then are the pieces cut into triangles. So the shell has no T-junction anywhere.
#include "compiler/place/panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "compiler/base/elementary.h"
#include "compiler/geometry/chart.h"
#include "compiler/place/rail.h"

namespace orbc::place {
namespace {

using geometry::Point;
using geometry::Space;
using Keys = std::vector<std::set<double>>;     // per wall: arc lengths

/// The plain part of one wall as cells of a grid; all points where cells meet are grid points.
struct WallGrid {
  struct Cell {
    std::size_t i = 0, j = 0;
    int tag = 0;
  };
  std::vector<double> s, z;
  std::vector<Cell> cells;
};

/// Heights of the whole room, so that two that differ by rounding are one.
class Heights {
 public:
  explicit Heights(double height) : same_(1e-9 * height) {}
  double key(double z) {
    const auto after = known_.lower_bound(z - same_);
    return after != known_.end() && *after <= z + same_ ? *after : *known_.insert(z).first;
  }

 private:
  double same_;
  std::set<double> known_;
};

bool has_cells(const scene::Material& m) { return m.pattern == scene::Pattern::checker || m.pattern == scene::Pattern::texture; }

// ---- floor and ceiling ------------------------------------------------------------------------------------------------------

std::array<float, 2> disk_uv(Space space, const Point& p, double cell) {
  const std::complex<double> z = (space == Space::euclidean ? 1.0 : 2.0) / cell * geometry::disk_from_point(space, p);
  return {static_cast<float>(z.real()), static_cast<float>(-z.imag())};
}

// Largest distance, in repeats, between the true uv in the middle of an edge and the mean of its ends.
double uv_error(Space space, const Net& net, double cell) {
  double worst = 0;
  for (const Net::Piece& piece : net.pieces)
    for (std::size_t i = 0; i < piece.loop.size(); ++i) {
      const Point &p = net.vertices[piece.loop[i].vertex].floor, &q = net.vertices[piece.loop[(i + 1) % piece.loop.size()].vertex].floor;
      const std::complex<double> mean = 0.5 * (geometry::disk_from_point(space, p) + geometry::disk_from_point(space, q));
      worst = std::fmax(worst, 2 / cell * math::abs(geometry::disk_from_point(space, geometry::midpoint(space, p, q)) - mean));
    }
  return worst;
}

// The lines of both axial families meet on the border w = 0 of a half sphere, which they therefore do not divide; lines through the centre
// do.
void cut_by_spokes(Net& net, double step) {
  const int count = static_cast<int>(std::ceil(std::numbers::pi / step));
  for (int i = 0; i < count; ++i) {
    const double angle = std::numbers::pi * (i + 0.5) / count;
    Halves halves = cut(Space::spherical, net, net.pieces, {0, -math::sin(angle), math::cos(angle)}, -1'000'000 - i);
    net.pieces = std::move(halves.left);
    net.pieces.insert(net.pieces.end(), halves.right.begin(), halves.right.end());
  }
}

Result<Net> level_net(const room::Room& room, const scene::Material& material, const PanelOptions& options) {
  if (material.pattern == scene::Pattern::checker) return floor_net(room, material.cell, options.max_cells);
  if (material.pattern != scene::Pattern::texture || room.space == Space::euclidean) return floor_net(room, 0, options.max_cells);
  const double bound = options.texel_error / options.texture_size;
  for (double step = 0.25;; step /= 2) {
    Result<Net> net = floor_net(room, step, options.max_cells);
    if (net && room.space == Space::spherical && room.circumradius > 1.5) cut_by_spokes(*net, step);
    // Finer than this is not worth the triangles.
    if (!net || uv_error(room.space, *net, material.cell) <= bound || net->pieces.size() > 20'000) return net;
  }
}

// Puts the net's border vertices on the rails and tells which places of each wall they use.
Keys join_to_rails(Net& net, std::vector<Rail>& rails) {
  Keys used(rails.size());
  for (const Net::Piece& piece : net.pieces)
    for (std::size_t i = 0; i < piece.loop.size(); ++i) {
      const int wall = piece.loop[i].side;
      if (wall < 0) continue;
      for (const std::uint32_t v : {piece.loop[i].vertex, piece.loop[(i + 1) % piece.loop.size()].vertex}) {
        const double key = rails[wall].key(net.vertices[v].floor);
        net.vertices[v].floor = rails[wall].at(key);
        used[wall].insert(key);
      }
    }
  return used;
}

// Adds the places of `keys` to the border edges that pass them.
void insert_on_border(const room::Room& room, Net& net, std::vector<Rail>& rails, const Keys& keys) {
  for (Net::Piece& piece : net.pieces) {
    std::vector<Net::Edge> loop;
    for (std::size_t i = 0; i < piece.loop.size(); ++i) {
      const Net::Edge edge = piece.loop[i];
      loop.push_back(edge);
      if (edge.side < 0) continue;
      const double length = room.walls[edge.side].length;
      double from = rails[edge.side].key(net.vertices[edge.vertex].floor);
      double to = rails[edge.side].key(net.vertices[piece.loop[(i + 1) % piece.loop.size()].vertex].floor);
      if (room.corners.empty() && from == length) from = 0;
      if (room.corners.empty() && to == 0) to = length;
      for (auto key = keys[edge.side].upper_bound(from); key != keys[edge.side].end() && *key < to; ++key) {
        loop.push_back({static_cast<std::uint32_t>(net.vertices.size()), edge.side});
        net.vertices.push_back({rails[edge.side].at(*key), 0});
      }
    }
    piece.loop = std::move(loop);
  }
}

PlacedMesh level_mesh(const room::Room& room, Net net, double z, bool ceiling, const scene::Material& material) {
  PlacedMesh mesh;
  mesh.kind = ceiling ? PartKind::ceiling : PartKind::floor;
  mesh.name = ceiling ? "ceiling" : "floor";
  const bool whole = net.pieces.size() == 1;
  if (whole) net.vertices.push_back({Point{}, 0});
  for (const Net::Piece& piece : net.pieces)
    for (mesh::Triangle t : whole ? fan(piece, static_cast<std::uint32_t>(net.vertices.size() - 1)) : triangulate(room.space, net, piece)) {
      if (ceiling) std::swap(t[1], t[2]);
      mesh.triangles.push_back(t);
      mesh.look.push_back(static_cast<std::uint16_t>(material.pattern == scene::Pattern::checker ? piece.tag : 0));
    }
  for (const geometry::Position& vertex : net.vertices) {
    mesh.floor.push_back(vertex.floor);
    mesh.z.push_back(z);
    if (material.pattern == scene::Pattern::texture) mesh.uv.push_back(disk_uv(room.space, vertex.floor, material.cell));
  }
  return mesh;
}

// ---- walls ------------------------------------------------------------------------------------------------------------------

// Longest piece of a wall on which a texture's place, affine in the triangle, stays true: along an edge of length l the arc length differs
// from the affine one by at most 0.0161·l³ (atanh(x·tanh h) − x·h = −h³(x − x³)/3 + …, h = l/2, |x − x³| ≤ 0.385).
double texture_step(Space space, const scene::Material& material, const PanelOptions& options) {
  if (space == Space::euclidean || material.pattern != scene::Pattern::texture) return 1e9;
  return std::fmin(1, math::cbrt(options.texel_error / options.texture_size * material.cell / 0.0161));
}

std::vector<double> with_steps(const std::vector<double>& breaks, double step) {
  std::vector<double> fine;
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    fine.push_back(breaks[i]);
    if (i + 1 == breaks.size()) break;
    const int n = static_cast<int>(std::ceil((breaks[i + 1] - breaks[i]) / step));
    for (int j = 1; j < n; ++j) fine.push_back(breaks[i] + (breaks[i + 1] - breaks[i]) * j / n);
  }
  return fine;
}

Result<WallGrid> wall_grid(const room::Room& room, int wall, double height, const scene::Material& material,
                           const std::vector<PlacedMirror>& mirrors, Rail& rail, Heights& heights, const PanelOptions& options) {
  const double length = room.walls[wall].length, cell = material.cell;
  std::set<double> s(rail.given().begin(), rail.given().end()), z{heights.key(0), heights.key(height)};
  for (const PlacedMirror& mirror : mirrors)
    if (mirror.wall == wall)
      for (int end = 0; end < 2; ++end) s.insert(rail.key(mirror.span[end])), z.insert(heights.key(mirror.height[end]));
  if (has_cells(material)) {
    if (!(cell > 0) || !((length / cell + 2) * (height / cell + 2) <= static_cast<double>(options.max_cells)))
      return make_error("place.too-many-cells",
                        fmt::format("cells of {:.4g} cut wall {} into more than {} pieces", cell, wall + 1, options.max_cells),
                        fmt::format("a cell of {:.2g} fits", 1.3 * std::sqrt(length * height / static_cast<double>(options.max_cells))));
    for (int i = 1; i * cell < length; ++i) s.insert(rail.key(i * cell));
    for (int j = 1; j * cell < height; ++j) z.insert(heights.key(j * cell));
  }
  WallGrid grid;
  for (const double fine : with_steps({s.begin(), s.end()}, texture_step(room.space, material, options))) grid.s.push_back(rail.key(fine));
  grid.z.assign(z.begin(), z.end());
  for (std::size_t i = 0; i + 1 < grid.s.size(); ++i)
    for (std::size_t j = 0; j + 1 < grid.z.size(); ++j) {
      const double at = 0.5 * (grid.s[i] + grid.s[i + 1]), level = 0.5 * (grid.z[j] + grid.z[j + 1]);
      const bool open = std::any_of(mirrors.begin(), mirrors.end(), [&](const PlacedMirror& m) {
        return m.wall == wall && m.span[0] <= at && at <= m.span[1] && m.height[0] <= level && level <= m.height[1];
      });
      const int parity =
          has_cells(material) ? (static_cast<int>(std::floor(at / cell)) + static_cast<int>(std::floor(level / cell))) & 1 : 0;
      if (!open) grid.cells.push_back({i, j, parity});
    }
  return grid;
}

/// What a wall's plain cells use of its four edges.
struct WallEdges {
  std::set<double> foot, head, start, end;
};

WallEdges edges_of(const WallGrid& grid) {
  WallEdges edges;
  for (const WallGrid::Cell& c : grid.cells) {
    if (c.j == 0) edges.foot.insert({grid.s[c.i], grid.s[c.i + 1]});
    if (c.j + 2 == grid.z.size()) edges.head.insert({grid.s[c.i], grid.s[c.i + 1]});
    if (c.i == 0) edges.start.insert({grid.z[c.j], grid.z[c.j + 1]});
    if (c.i + 2 == grid.s.size()) edges.end.insert({grid.z[c.j], grid.z[c.j + 1]});
  }
  return edges;
}

// Loops run clockwise in (s, z): seen from inside the room, s runs to the left.
PlacedMesh wall_mesh(const room::Room& room, int wall, const WallGrid& grid, const WallEdges& shared, const Rail& rail,
                     const scene::Material& material) {
  Net net;
  std::vector<std::array<double, 2>> places;
  std::map<std::pair<double, double>, std::uint32_t> known;
  const auto vertex = [&](double s, double z) {
    const auto [at, is_new] = known.try_emplace({s, z}, static_cast<std::uint32_t>(net.vertices.size()));
    if (is_new) net.vertices.push_back({rail.at(s), z}), places.push_back({s, z});
    return at->second;
  };
  const auto between = [](const std::set<double>& keys, double low, double high) {
    return std::vector<double>(keys.upper_bound(low), keys.lower_bound(high));
  };
  PlacedMesh mesh;
  mesh.kind = PartKind::wall;
  mesh.name = fmt::format("wall {}", wall + 1);
  mesh.wall = wall;
  for (const WallGrid::Cell& c : grid.cells) {
    const double s0 = grid.s[c.i], s1 = grid.s[c.i + 1], z0 = grid.z[c.j], z1 = grid.z[c.j + 1];
    Net::Piece piece{{{vertex(s0, z0), 0}}, c.tag};
    if (c.i == 0)
      for (const double z : between(shared.start, z0, z1)) piece.loop.push_back({vertex(s0, z), 0});
    piece.loop.push_back({vertex(s0, z1), 1});
    if (c.j + 2 == grid.z.size())
      for (const double s : between(shared.head, s0, s1)) piece.loop.push_back({vertex(s, z1), 1});
    piece.loop.push_back({vertex(s1, z1), 2});
    if (c.i + 2 == grid.s.size()) {
      const std::vector<double> zs = between(shared.end, z0, z1);
      for (auto z = zs.rbegin(); z != zs.rend(); ++z) piece.loop.push_back({vertex(s1, *z), 2});
    }
    piece.loop.push_back({vertex(s1, z0), 3});
    if (c.j == 0) {
      const std::vector<double> ss = between(shared.foot, s0, s1);
      for (auto s = ss.rbegin(); s != ss.rend(); ++s) piece.loop.push_back({vertex(*s, z0), 3});
    }
    for (const mesh::Triangle& t : triangulate(room.space, net, piece)) {
      mesh.triangles.push_back(t);
      mesh.look.push_back(static_cast<std::uint16_t>(material.pattern == scene::Pattern::checker ? c.tag : 0));
    }
    // A hub stands in the middle of its cell.
    while (places.size() < net.vertices.size())
      places.push_back({arc_on_wall(room, wall, net.vertices[places.size()].floor), net.vertices[places.size()].z});
  }
  for (std::size_t v = 0; v < net.vertices.size(); ++v) {
    mesh.floor.push_back(net.vertices[v].floor);
    mesh.z.push_back(net.vertices[v].z);
    if (material.pattern == scene::Pattern::texture)
      mesh.uv.push_back({static_cast<float>(places[v][0] / material.cell), static_cast<float>(-places[v][1] / material.cell)});
  }
  return mesh;
}

void merge(std::set<double>& into, const std::set<double>& from) { into.insert(from.begin(), from.end()); }

}  // namespace

Result<std::vector<PlacedMesh>> make_panels(const room::Room& room, double height, const Shell& shell,
                                            const std::vector<PlacedMirror>& mirrors, const PanelOptions& options) {
  const std::size_t n = room.walls.size();
  std::vector<Rail> rails = make_rails(room);
  Heights heights(height);
  heights.key(0), heights.key(height);
  for (const PlacedMirror& mirror : mirrors) heights.key(mirror.height[0]), heights.key(mirror.height[1]);
  std::vector<WallGrid> grids;
  std::vector<WallEdges> shared;
  for (std::size_t i = 0; i < n; ++i) {
    Result<WallGrid> grid = wall_grid(room, static_cast<int>(i), height, shell.walls[i], mirrors, rails[i], heights, options);
    if (!grid) return std::move(grid).error();
    shared.push_back(edges_of(*grid));
    grids.push_back(*std::move(grid));
  }
  const std::optional<scene::Material>* levels[2] = {&shell.floor, &shell.ceiling};
  std::optional<Net> nets[2];
  for (int level = 0; level < 2; ++level) {
    if (!*levels[level]) continue;
    Result<Net> net = level_net(room, **levels[level], options);
    if (!net) return std::move(net).error();
    nets[level] = *std::move(net);
    const Keys used = join_to_rails(*nets[level], rails);
    for (std::size_t i = 0; i < n; ++i) merge(level == 0 ? shared[i].foot : shared[i].head, used[i]);
  }
  std::vector<PlacedMesh> parts;
  for (int level = 0; level < 2; ++level) {
    if (!nets[level]) continue;
    Keys keys(n);
    for (std::size_t i = 0; i < n; ++i) keys[i] = level == 0 ? shared[i].foot : shared[i].head;
    insert_on_border(room, *nets[level], rails, keys);
    parts.push_back(level_mesh(room, *std::move(nets[level]), level == 0 ? 0 : height, level == 1, **levels[level]));
  }
  for (std::size_t i = 0; i < n; ++i) {
    std::set<double>&end = shared[i].end, &start = shared[(i + 1) % n].start;
    merge(end, start), merge(start, end);
  }
  for (std::size_t i = 0; i < n; ++i)
    if (!grids[i].cells.empty()) parts.push_back(wall_mesh(room, static_cast<int>(i), grids[i], shared[i], rails[i], shell.walls[i]));
  return parts;
}

}  // namespace orbc::place
