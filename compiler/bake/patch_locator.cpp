#include "compiler/bake/patch_locator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "compiler/base/elementary.h"

namespace orbc::bake {
namespace {

using geometry::Point;
using place::PartKind;
using place::PlacedMesh;

/// The place (u, v) of a point of a triangle in its patch: the inverse of barycentric_point.
PatchUv place_on(const TexelPatch& patch, int index, std::size_t triangle, const std::array<double, 3>& b) {
  if (triangle == patch.first)
    return {index, static_cast<float>(b[static_cast<std::size_t>(patch.corner_order[1])]),
            static_cast<float>(b[static_cast<std::size_t>(patch.corner_order[2])])};
  return {index, static_cast<float>(1 - b[static_cast<std::size_t>(patch.second_corner_order[1])]),
          static_cast<float>(1 - b[static_cast<std::size_t>(patch.second_corner_order[2])])};
}

/// Coordinates (p, v) of a point of a wall in the ambient plane through the origin that holds the wall: p along the middle of the wall, v
/// along its direction there. In E² the plane is the line itself, and p is 1.
std::array<double, 2> in_plane_of_wall(geometry::Space space, const room::Wall& wall, const Point& at) {
  const double k = geometry::curvature(space), half = wall.length / 2;
  if (k == 0) return {1, (at.x - wall.start.x) * wall.along.x + (at.y - wall.start.y) * wall.along.y - half};
  const double p = at.w * wall.start.w + k * (at.x * wall.start.x + at.y * wall.start.y);
  const double v = k * at.w * wall.along.w + at.x * wall.along.x + at.y * wall.along.y;
  const double c = geometry::cos_k(space, half), s = geometry::sin_k(space, half);
  return {c * p + k * s * v, c * v - s * p};
}

}  // namespace

// The cell of a coordinate, which is first moved by `shift` cells. Outside of the grid the nearest cell; the first cell of NaN.
int PatchLocator::cell_of(const CellGrid& grid, int c, double at, double shift) {
  const double cell = (at - grid.low[c]) / grid.size[c] + shift;
  return cell > 0 ? static_cast<int>(std::min(cell, grid.cells - 1.0)) : 0;
}

PatchLocator::PatchLocator(const place::Interior& interior, std::span<const std::vector<TexelPatch>> patches) : interior_(interior) {
  shell_parts_.resize(2 + interior.polygon.walls.size());
  for (std::size_t p = 0; p < std::min(interior.parts.size(), patches.size()); ++p) {
    const PlacedMesh& part = interior.parts[p];
    std::vector<std::uint32_t>& of = patch_of_triangle_.emplace_back(part.triangles.size());
    for (const TexelPatch& patch : patches[p]) {
      of[patch.first] = static_cast<std::uint32_t>(patches_.size());
      if (patch.second >= 0) of[static_cast<std::size_t>(patch.second)] = static_cast<std::uint32_t>(patches_.size());
      patches_.push_back(&patch);
    }
    const bool is_flat = part.kind != PartKind::object && part.kind != PartKind::frame;
    cell_grids_.push_back(is_flat ? make_cell_grid(part) : CellGrid{});
    if (is_flat)
      shell_parts_[part.kind == PartKind::floor     ? 0
                   : part.kind == PartKind::ceiling ? 1
                                                    : 2 + static_cast<std::size_t>(part.wall)]
          .push_back(p);
  }
}

// Coordinates by which points are sorted into cells; they are bounded on each part. Of floor and ceiling those of the gnomonic chart; on
// S², where w may vanish, those of the disk chart. Of walls the arc length from the middle of the wall, and z.
std::array<double, 2> PatchLocator::cell_coordinates(const PlacedMesh& part, const Point& at, double z) const {
  const geometry::Space space = interior_.polygon.space;
  if (part.kind == PartKind::wall) {
    const auto [p, v] = in_plane_of_wall(space, interior_.polygon.walls[static_cast<std::size_t>(part.wall)], at);
    const double s = space == geometry::Space::euclidean ? v : space == geometry::Space::spherical ? math::atan2(v, p) : math::atanh(v / p);
    return {s, z};
  }
  const double scale = space == geometry::Space::spherical ? 1 + at.w : at.w;
  return {at.x / scale, at.y / scale};
}

// Affine barycentric coordinates by the definition of the geodesic triangle, P ∥ Σ bᵢXᵢ. Nothing is divided by a coordinate.
std::array<double, 3> PatchLocator::barycentric(const PlacedMesh& part, const mesh::Triangle& t, const Point& at, double z) const {
  std::array<double, 3> b{};
  if (part.kind == PartKind::wall) {
    // Σ bᵢ·(Xᵢ × P) = 0 in the plane that holds the wall, Σ bᵢzᵢ = z, Σ bᵢ = 1.
    const room::Wall& wall = interior_.polygon.walls[static_cast<std::size_t>(part.wall)];
    const auto [p, v] = in_plane_of_wall(interior_.polygon.space, wall, at);
    geometry::Vector3 corner[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [pk, vk] = in_plane_of_wall(interior_.polygon.space, wall, part.floor[t[k]]);
      corner[k] = {pk * v - vk * p, part.z[t[k]] - z, 1};
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const geometry::Vector3 &q = corner[(k + 1) % 3], &r = corner[(k + 2) % 3];
      b[k] = q.x * r.y - q.y * r.x;
    }
  } else {
    const auto vector = [](const Point& q) { return geometry::Vector3{q.w, q.x, q.y}; };
    for (std::size_t k = 0; k < 3; ++k)
      b[k] = dot(vector(at), cross(vector(part.floor[t[(k + 1) % 3]]), vector(part.floor[t[(k + 2) % 3]])));
  }
  const double sum = b[0] + b[1] + b[2];
  geometry::Ambient there{0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    b[k] /= sum;
    there = there + b[k] * part.floor[t[k]];
  }
  // The antipode of a point solves the same equations. In a triangle without area all are NaN.
  const bool here = there.w * at.w + there.x * at.x + there.y * at.y > 0;
  return here ? b : std::array<double, 3>{-1, -1, -1};
}

PatchLocator::CellGrid PatchLocator::make_cell_grid(const PlacedMesh& part) const {
  CellGrid grid;
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const bool sphere = interior_.polygon.space == geometry::Space::spherical;
  double high[2] = {-kInfinite, -kInfinite};
  grid.low[0] = grid.low[1] = kInfinite;
  std::vector<std::array<double, 2>> at;
  for (std::size_t v = 0; v < part.floor.size(); ++v) {
    at.push_back(cell_coordinates(part, part.floor[v], part.z[v]));
    for (std::size_t c = 0; c < 2; ++c) {
      grid.low[c] = std::min(grid.low[c], at.back()[c]);
      high[c] = std::max(high[c], at.back()[c]);
    }
  }
  grid.cells = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(part.triangles.size()))), 1, 256);
  for (int c = 0; c < 2; ++c) grid.size[c] = std::max(high[c] - grid.low[c], 1e-12) / grid.cells;
  grid.triangles.resize(static_cast<std::size_t>(grid.cells) * static_cast<std::size_t>(grid.cells));
  for (std::uint32_t t = 0; t < part.triangles.size(); ++t) {
    std::array<std::array<double, 2>, 3> q{at[part.triangles[t][0]], at[part.triangles[t][1]], at[part.triangles[t][2]]};
    double bulge = 0;
    bool around = false;
    if (sphere && part.kind == PartKind::wall) {
      // A wall may be a whole great circle: a triangle that crosses the far end of the arc lies at both ends of the grid.
      for (std::size_t k = 1; k < 3; ++k) q[k][0] += 2 * std::numbers::pi * std::round((q[0][0] - q[k][0]) / (2 * std::numbers::pi));
      around = std::max({q[0][0], q[1][0], q[2][0]}) > std::numbers::pi || std::min({q[0][0], q[1][0], q[2][0]}) < -std::numbers::pi;
    } else if (sphere) {
      // Edges are arcs of less than half a circle: none is farther from its chord than half the length of the chord.
      for (std::size_t k = 0; k < 3; ++k)
        bulge = std::max(bulge, math::hypot(q[(k + 1) % 3][0] - q[k][0], q[(k + 1) % 3][1] - q[k][1]) / 2);
    }
    for (const double period : {0.0, -2 * std::numbers::pi, 2 * std::numbers::pi}) {
      if (period != 0 && !around) continue;
      int from[2], to[2];
      for (std::size_t c = 0; c < 2; ++c) {
        const double a = std::min({q[0][c], q[1][c], q[2][c]}) - bulge + (c == 0 ? period : 0),
                     b = std::max({q[0][c], q[1][c], q[2][c]}) + bulge + (c == 0 ? period : 0);
        from[c] = std::max(0, cell_of(grid, static_cast<int>(c), a, -0.01));
        to[c] = cell_of(grid, static_cast<int>(c), b, 0.01);
        if (period != 0 && c == 0 && (b < grid.low[0] || a > high[0])) to[0] = -1;
      }
      for (int y = from[1]; y <= to[1]; ++y)
        for (int x = from[0]; x <= to[0]; ++x) grid.triangles[static_cast<std::size_t>(y * grid.cells + x)].push_back(t);
    }
  }
  return grid;
}

PatchUv PatchLocator::on_triangle(std::size_t part, std::size_t triangle, const std::array<double, 3>& b) const {
  const std::uint32_t patch = patch_of_triangle_[part][triangle];
  return place_on(*patches_[patch], static_cast<int>(patch), triangle, b);
}

PatchUv PatchLocator::find_on_shell(std::size_t p, const trace::SurfacePoint& point) const {
  const PlacedMesh& part = interior_.parts[p];
  const CellGrid& grid = cell_grids_[p];
  const std::array<double, 2> at = cell_coordinates(part, point.at.floor, point.at.z);
  const int x = cell_of(grid, 0, at[0], 0), y = cell_of(grid, 1, at[1], 0);
  double best = -0.05;  // barycentric; a point may lie a little outside of all triangles, because panels end where frames begin
  PatchUv found;
  for (const std::uint32_t t : grid.triangles[static_cast<std::size_t>(y * grid.cells + x)]) {
    const std::array<double, 3> b = barycentric(part, part.triangles[t], point.at.floor, point.at.z);
    const double inside = std::min({b[0], b[1], b[2]});
    if (!(inside > best)) continue;
    best = inside;
    found = on_triangle(p, t, b);
    if (inside >= 0) break;
  }
  return found;
}

PatchUv PatchLocator::find(const trace::SurfacePoint& point, const trace::Hit& hit) const {
  if (hit.kind == trace::HitKind::triangle)
    return on_triangle(static_cast<std::size_t>(hit.part), static_cast<std::size_t>(hit.triangle), {hit.b[0], hit.b[1], hit.b[2]});
  const std::size_t flat = hit.kind == trace::HitKind::floor     ? 0
                           : hit.kind == trace::HitKind::ceiling ? 1
                                                                 : 2 + static_cast<std::size_t>(hit.wall);
  for (const std::size_t p : shell_parts_[flat])
    if (const PatchUv found = find_on_shell(p, point); found.patch >= 0) return found;
  return {};
}

PatchUv PatchLocator::find_for_lod(const trace::Hit& hit, std::uint16_t style) const {
  if (hit.kind != trace::HitKind::triangle) return {};
  const auto part = static_cast<std::size_t>(hit.part), triangle = static_cast<std::size_t>(hit.triangle);
  if (interior_.parts[part].style[triangle] != style) return {};
  return on_triangle(part, triangle, {hit.b[0], hit.b[1], hit.b[2]});
}

}  // namespace orbc::bake
