// Every panel is first cut into convex polygons. Then panels that meet exchange the points of their common edge (the foot or head of a
// wall, or the vertical edge in a corner), and only then are the polygons triangulated. So the shell has no T-junctions.
#include "compiler/place/panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "compiler/base/elementary.h"
#include "compiler/geometry/chart.h"
#include "compiler/place/shared_wall_points.h"

namespace orbc::place {
namespace {

using geometry::Point;
using geometry::Space;
using ArcKeys = std::vector<std::set<double>>;  // per wall: arc lengths of shared points

/// The part of one wall beside its mirrors, as cells of a grid over (arc length, z).
struct WallGrid {
  struct Cell {
    std::size_t i = 0, j = 0;  ///< from s[i] to s[i+1], from z[j] to z[j+1]
    int parity = 0;            ///< of the checker's cell
  };
  std::vector<double> s, z;
  std::vector<Cell> cells;
};

/// The heights of all panels' vertices. Invariant: heights that differ by rounding are one height.
class HeightIndex {
 public:
  explicit HeightIndex(double height) : tolerance_(1e-9 * height) {}
  double key(double z) {
    const auto after = known_.lower_bound(z - tolerance_);
    return after != known_.end() && *after <= z + tolerance_ ? *after : *known_.insert(z).first;
  }

 private:
  double tolerance_;
  std::set<double> known_;
};

bool has_cells(const scene::Material& m) { return m.pattern == scene::Pattern::checker || m.pattern == scene::Pattern::texture; }

// ---- floor and ceiling ------------------------------------------------------------------------------------------------------

std::array<float, 2> disk_uv(Space space, const Point& p, double cell) {
  const std::complex<double> z = (space == Space::euclidean ? 1.0 : 2.0) / cell * geometry::disk_from_point(space, p);
  return {static_cast<float>(z.real()), static_cast<float>(-z.imag())};
}

// The largest distance, in repeats, between the exact uv in the middle of an edge and the mean of its ends.
double uv_error(Space space, const PolygonMesh& surface, double cell) {
  double worst = 0;
  for (const PolygonMesh::Polygon& polygon : surface.polygons)
    for (std::size_t i = 0; i < polygon.loop.size(); ++i) {
      const Point &p = surface.vertices[polygon.loop[i].vertex].floor,
                  &q = surface.vertices[polygon.loop[(i + 1) % polygon.loop.size()].vertex].floor;
      const std::complex<double> mean = 0.5 * (geometry::disk_from_point(space, p) + geometry::disk_from_point(space, q));
      worst = std::fmax(worst, 2 / cell * math::abs(geometry::disk_from_point(space, geometry::midpoint(space, p, q)) - mean));
    }
  return worst;
}

// The lines of both axial families meet on the boundary w = 0 of a hemisphere and do not divide it. Lines through the centre do.
void cut_by_spokes(PolygonMesh& surface, double step) {
  const int count = static_cast<int>(std::ceil(std::numbers::pi / step));
  for (int i = 0; i < count; ++i) {
    const double angle = std::numbers::pi * (i + 0.5) / count;
    SplitResult split =
        split_by_line(Space::spherical, surface, surface.polygons, {0, -math::sin(angle), math::cos(angle)}, -1'000'000 - i);
    surface.polygons = std::move(split.left);
    surface.polygons.insert(surface.polygons.end(), split.right.begin(), split.right.end());
  }
}

Result<PolygonMesh> horizontal_polygons(const room::Room& room, const scene::Material& material, const PanelOptions& options) {
  if (material.pattern == scene::Pattern::checker) return floor_polygons(room, material.cell, options.max_cells);
  if (material.pattern != scene::Pattern::texture || room.space == Space::euclidean) return floor_polygons(room, 0, options.max_cells);
  const double bound = options.texel_error / options.texture_size;
  for (double step = 0.25;; step /= 2) {
    Result<PolygonMesh> surface = floor_polygons(room, step, options.max_cells);
    if (surface && room.space == Space::spherical && room.circumradius > 1.5) cut_by_spokes(*surface, step);
    // Finer panels would not be worth their triangles.
    if (!surface || uv_error(room.space, *surface, material.cell) <= bound || surface->polygons.size() > 20'000) return surface;
  }
}

// Recoordinates the vertices on the boundary by shared points. Makes: the keys of the shared points that they use.
ArcKeys snap_to_shared_points(PolygonMesh& surface, std::vector<SharedWallPoints>& wall_points) {
  ArcKeys used(wall_points.size());
  for (const PolygonMesh::Polygon& polygon : surface.polygons)
    for (std::size_t i = 0; i < polygon.loop.size(); ++i) {
      const int wall = polygon.loop[i].side;
      if (wall < 0) continue;
      for (const std::uint32_t v : {polygon.loop[i].vertex, polygon.loop[(i + 1) % polygon.loop.size()].vertex}) {
        const double key = wall_points[wall].key(surface.vertices[v].floor);
        surface.vertices[v].floor = wall_points[wall].at(key);
        used[wall].insert(key);
      }
    }
  return used;
}

// Adds the shared points `keys` to the boundary edges that contain them.
void insert_shared_points(const room::Room& room, PolygonMesh& surface, std::vector<SharedWallPoints>& wall_points, const ArcKeys& keys) {
  for (PolygonMesh::Polygon& polygon : surface.polygons) {
    std::vector<PolygonMesh::Edge> loop;
    for (std::size_t i = 0; i < polygon.loop.size(); ++i) {
      const PolygonMesh::Edge edge = polygon.loop[i];
      loop.push_back(edge);
      if (edge.side < 0) continue;
      const double length = room.walls[edge.side].length;
      double from = wall_points[edge.side].key(surface.vertices[edge.vertex].floor);
      double to = wall_points[edge.side].key(surface.vertices[polygon.loop[(i + 1) % polygon.loop.size()].vertex].floor);
      if (room.corners.empty() && from == length) from = 0;
      if (room.corners.empty() && to == 0) to = length;
      for (auto key = keys[edge.side].upper_bound(from); key != keys[edge.side].end() && *key < to; ++key) {
        loop.push_back({static_cast<std::uint32_t>(surface.vertices.size()), edge.side});
        surface.vertices.push_back({wall_points[edge.side].at(*key), 0});
      }
    }
    polygon.loop = std::move(loop);
  }
}

PlacedMesh horizontal_mesh(const room::Room& room, PolygonMesh surface, double z, bool ceiling, const scene::Material& material) {
  PlacedMesh mesh;
  mesh.kind = ceiling ? PartKind::ceiling : PartKind::floor;
  mesh.name = ceiling ? "ceiling" : "floor";
  const bool whole = surface.polygons.size() == 1;
  if (whole) surface.vertices.push_back({Point{}, 0});
  for (const PolygonMesh::Polygon& polygon : surface.polygons)
    for (mesh::Triangle t :
         whole ? fan(polygon, static_cast<std::uint32_t>(surface.vertices.size() - 1)) : triangulate(room.space, surface, polygon)) {
      if (ceiling) std::swap(t[1], t[2]);
      mesh.triangles.push_back(t);
      mesh.style.push_back(static_cast<std::uint16_t>(material.pattern == scene::Pattern::checker ? polygon.label : 0));
    }
  for (const geometry::Position& vertex : surface.vertices) {
    mesh.floor.push_back(vertex.floor);
    mesh.z.push_back(z);
    if (material.pattern == scene::Pattern::texture) mesh.uv.push_back(disk_uv(room.space, vertex.floor, material.cell));
  }
  return mesh;
}

// ---- walls ------------------------------------------------------------------------------------------------------------------

// The longest edge of a wall along which linear uv are accurate enough: along an edge of length l the arc length differs from the linear
// one by at most 0.0161·l³ (atanh(x·tanh h) − x·h = −h³(x − x³)/3 + …, h = l/2, |x − x³| ≤ 0.385).
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

/// A wall that is to be cut into a grid.
struct GridWall {
  const room::Room& room;
  int wall = 0;                     ///< from 0
  double height = 1;                ///< of the room
  const scene::Material& material;
};

Result<WallGrid> wall_grid(const GridWall& grid_wall, const std::vector<PlacedMirror>& mirrors, SharedWallPoints& points,
                           HeightIndex& heights, const PanelOptions& options) {
  const room::Room& room = grid_wall.room;
  const scene::Material& material = grid_wall.material;
  const int wall = grid_wall.wall;
  const double height = grid_wall.height;
  const double length = room.walls[wall].length, cell = material.cell;
  std::set<double> s(points.outline_keys().begin(), points.outline_keys().end()), z{heights.key(0), heights.key(height)};
  for (const PlacedMirror& mirror : mirrors) {
    if (mirror.wall != wall) continue;
    for (int end = 0; end < 2; ++end) {
      s.insert(points.key(mirror.span[end]));
      z.insert(heights.key(mirror.height[end]));
    }
  }
  if (has_cells(material)) {
    if (!(cell > 0) || !((length / cell + 2) * (height / cell + 2) <= static_cast<double>(options.max_cells)))
      return make_error("place.too-many-cells",
                        fmt::format("cells of {:.4g} cut wall {} into more than {} pieces", cell, wall + 1, options.max_cells),
                        fmt::format("a cell of {:.2g} fits", 1.3 * std::sqrt(length * height / static_cast<double>(options.max_cells))));
    for (int i = 1; i * cell < length; ++i) s.insert(points.key(i * cell));
    for (int j = 1; j * cell < height; ++j) z.insert(heights.key(j * cell));
  }
  WallGrid grid;
  for (const double fine : with_steps({s.begin(), s.end()}, texture_step(room.space, material, options)))
    grid.s.push_back(points.key(fine));
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

/// The arc lengths and heights of a panel's vertices on the four edges of its wall.
struct BorderVertices {
  std::set<double> foot, head, start, end;
};

BorderVertices border_vertices(const WallGrid& grid) {
  BorderVertices edges;
  for (const WallGrid::Cell& c : grid.cells) {
    if (c.j == 0) edges.foot.insert({grid.s[c.i], grid.s[c.i + 1]});
    if (c.j + 2 == grid.z.size()) edges.head.insert({grid.s[c.i], grid.s[c.i + 1]});
    if (c.i == 0) edges.start.insert({grid.z[c.j], grid.z[c.j + 1]});
    if (c.i + 2 == grid.s.size()) edges.end.insert({grid.z[c.j], grid.z[c.j + 1]});
  }
  return edges;
}

// Loops are clockwise in (s, z), because seen from inside the room s increases to the left.
PlacedMesh wall_mesh(const room::Room& room, int wall, const WallGrid& grid, const BorderVertices& shared, const SharedWallPoints& points,
                     const scene::Material& material) {
  PolygonMesh surface;
  std::vector<std::array<double, 2>> coordinates;
  std::map<std::pair<double, double>, std::uint32_t> known;
  const auto vertex = [&](double s, double z) {
    const auto [at, is_new] = known.try_emplace({s, z}, static_cast<std::uint32_t>(surface.vertices.size()));
    if (is_new) {
      surface.vertices.push_back({points.at(s), z});
      coordinates.push_back({s, z});
    }
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
    PolygonMesh::Polygon polygon{{{vertex(s0, z0), 0}}, c.parity};
    if (c.i == 0)
      for (const double z : between(shared.start, z0, z1)) polygon.loop.push_back({vertex(s0, z), 0});
    polygon.loop.push_back({vertex(s0, z1), 1});
    if (c.j + 2 == grid.z.size())
      for (const double s : between(shared.head, s0, s1)) polygon.loop.push_back({vertex(s, z1), 1});
    polygon.loop.push_back({vertex(s1, z1), 2});
    if (c.i + 2 == grid.s.size()) {
      const std::vector<double> zs = between(shared.end, z0, z1);
      for (auto z = zs.rbegin(); z != zs.rend(); ++z) polygon.loop.push_back({vertex(s1, *z), 2});
    }
    polygon.loop.push_back({vertex(s1, z0), 3});
    if (c.j == 0) {
      const std::vector<double> ss = between(shared.foot, s0, s1);
      for (auto s = ss.rbegin(); s != ss.rend(); ++s) polygon.loop.push_back({vertex(*s, z0), 3});
    }
    for (const mesh::Triangle& t : triangulate(room.space, surface, polygon)) {
      mesh.triangles.push_back(t);
      mesh.style.push_back(static_cast<std::uint16_t>(material.pattern == scene::Pattern::checker ? c.parity : 0));
    }
    // Coordinates of a vertex that triangulate has added.
    while (coordinates.size() < surface.vertices.size())
      coordinates.push_back({arc_on_wall(room, wall, surface.vertices[coordinates.size()].floor), surface.vertices[coordinates.size()].z});
  }
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    mesh.floor.push_back(surface.vertices[v].floor);
    mesh.z.push_back(surface.vertices[v].z);
    if (material.pattern == scene::Pattern::texture)
      mesh.uv.push_back({static_cast<float>(coordinates[v][0] / material.cell), static_cast<float>(-coordinates[v][1] / material.cell)});
  }
  return mesh;
}

void merge(std::set<double>& into, const std::set<double>& from) { into.insert(from.begin(), from.end()); }

}  // namespace

Result<std::vector<PlacedMesh>> make_panels(const room::Room& room, double height, const Shell& shell,
                                            const std::vector<PlacedMirror>& mirrors, const PanelOptions& options) {
  const std::size_t n = room.walls.size();
  std::vector<SharedWallPoints> wall_points = shared_wall_points(room);
  HeightIndex heights(height);
  heights.key(0);
  heights.key(height);
  for (const PlacedMirror& mirror : mirrors) {
    heights.key(mirror.height[0]);
    heights.key(mirror.height[1]);
  }
  std::vector<WallGrid> grids;
  std::vector<BorderVertices> shared;
  for (std::size_t i = 0; i < n; ++i) {
    Result<WallGrid> grid = wall_grid({room, static_cast<int>(i), height, shell.walls[i]}, mirrors, wall_points[i], heights, options);
    if (!grid) return std::move(grid).error();
    shared.push_back(border_vertices(*grid));
    grids.push_back(*std::move(grid));
  }
  const std::optional<scene::Material>* levels[2] = {&shell.floor, &shell.ceiling};
  std::optional<PolygonMesh> surfaces[2];
  for (int level = 0; level < 2; ++level) {
    if (!*levels[level]) continue;
    Result<PolygonMesh> surface = horizontal_polygons(room, **levels[level], options);
    if (!surface) return std::move(surface).error();
    surfaces[level] = *std::move(surface);
    const ArcKeys used = snap_to_shared_points(*surfaces[level], wall_points);
    for (std::size_t i = 0; i < n; ++i) merge(level == 0 ? shared[i].foot : shared[i].head, used[i]);
  }
  std::vector<PlacedMesh> parts;
  for (int level = 0; level < 2; ++level) {
    if (!surfaces[level]) continue;
    ArcKeys keys(n);
    for (std::size_t i = 0; i < n; ++i) keys[i] = level == 0 ? shared[i].foot : shared[i].head;
    insert_shared_points(room, *surfaces[level], wall_points, keys);
    parts.push_back(horizontal_mesh(room, *std::move(surfaces[level]), level == 0 ? 0 : height, level == 1, **levels[level]));
  }
  for (std::size_t i = 0; i < n; ++i) {
    std::set<double>&end = shared[i].end, &start = shared[(i + 1) % n].start;
    merge(end, start);
    merge(start, end);
  }
  for (std::size_t i = 0; i < n; ++i)
    if (!grids[i].cells.empty()) parts.push_back(wall_mesh(room, static_cast<int>(i), grids[i], shared[i], wall_points[i], shell.walls[i]));
  return parts;
}

}  // namespace orbc::place
