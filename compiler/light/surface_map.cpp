#include "compiler/light/surface_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace orbc::light {
namespace {

using geometry::Point;
using place::PartKind;
using place::PlacedMesh;

// (u, v) of a point of a block; the inverse of in_triangle.
OnBlock place_on(const Block& block, int index, std::size_t triangle, const std::array<double, 3>& b) {
  if (triangle == block.first)
    return {index, static_cast<float>(b[static_cast<std::size_t>(block.turn[1])]), static_cast<float>(b[static_cast<std::size_t>(block.turn[2])])};
  return {index, static_cast<float>(1 - b[static_cast<std::size_t>(block.second_turn[1])]),
          static_cast<float>(1 - b[static_cast<std::size_t>(block.second_turn[2])])};
}

}  // namespace

SurfaceMap::SurfaceMap(const place::PlacedRoom& room, const std::vector<std::vector<Block>>& blocks) : room_(room) {
  flats_.resize(2 + room.room.walls.size());
  for (std::size_t p = 0; p < room.parts.size(); ++p) {
    const PlacedMesh& part = room.parts[p];
    std::vector<std::uint32_t>& of = block_of_.emplace_back(part.triangles.size());
    for (const Block& block : blocks[p]) {
      of[block.first] = static_cast<std::uint32_t>(blocks_.size());
      if (block.second >= 0) of[static_cast<std::size_t>(block.second)] = static_cast<std::uint32_t>(blocks_.size());
      blocks_.push_back(&block);
    }
    const bool is_flat = part.kind != PartKind::object && part.kind != PartKind::frame;
    charts_.push_back(is_flat ? chart_of(part) : Chart{});
    if (is_flat) flats_[part.kind == PartKind::floor ? 0 : part.kind == PartKind::ceiling ? 1 : 2 + static_cast<std::size_t>(part.wall)].push_back(p);
  }
}

// Floor and ceiling in the gnomonic chart; a wall in (v/p, z/p) with p, v the coordinates of the ambient plane that holds it: straight both
// ways, since heights are affine in b, as p and v are.
std::array<double, 2> SurfaceMap::flat(const PlacedMesh& part, const Point& at, double z) const {
  if (part.kind != PartKind::wall) return {at.x / at.w, at.y / at.w};
  const room::Wall& wall = room_.room.walls[static_cast<std::size_t>(part.wall)];
  const double k = geometry::curvature(room_.room.space);
  if (k == 0) return {(at.x - wall.start.x) * wall.along.x + (at.y - wall.start.y) * wall.along.y, z};
  const double p = at.w * wall.start.w + k * (at.x * wall.start.x + at.y * wall.start.y);
  const double v = k * at.w * wall.along.w + at.x * wall.along.x + at.y * wall.along.y;
  return {std::atan2(v, p), z};
}

SurfaceMap::Chart SurfaceMap::chart_of(const PlacedMesh& part) const {
  Chart chart;
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  double high[2] = {-kInfinite, -kInfinite};
  chart.low[0] = chart.low[1] = kInfinite;
  std::vector<std::array<double, 2>> at;
  for (std::size_t v = 0; v < part.floor.size(); ++v) {
    at.push_back(flat(part, part.floor[v], part.z[v]));
    for (int c = 0; c < 2; ++c) chart.low[c] = std::min(chart.low[c], at.back()[c]), high[c] = std::max(high[c], at.back()[c]);
  }
  chart.cells = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(part.triangles.size()))), 1, 256);
  for (int c = 0; c < 2; ++c) chart.size[c] = std::max(high[c] - chart.low[c], 1e-12) / chart.cells;
  chart.triangles.resize(static_cast<std::size_t>(chart.cells) * static_cast<std::size_t>(chart.cells));
  for (std::uint32_t t = 0; t < part.triangles.size(); ++t) {
    int from[2], to[2];
    for (int c = 0; c < 2; ++c) {
      const auto [a, b] = std::minmax({at[part.triangles[t][0]][c], at[part.triangles[t][1]][c], at[part.triangles[t][2]][c]});
      from[c] = std::clamp(static_cast<int>(std::floor((a - chart.low[c]) / chart.size[c] - 0.01)), 0, chart.cells - 1);
      to[c] = std::clamp(static_cast<int>(std::floor((b - chart.low[c]) / chart.size[c] + 0.01)), 0, chart.cells - 1);
    }
    for (int y = from[1]; y <= to[1]; ++y)
      for (int x = from[0]; x <= to[0]; ++x) chart.triangles[static_cast<std::size_t>(y * chart.cells + x)].push_back(t);
  }
  return chart;
}

OnBlock SurfaceMap::on_triangle(std::size_t part, std::size_t triangle, const std::array<double, 3>& b) const {
  const std::uint32_t block = block_of_[part][triangle];
  return place_on(*blocks_[block], static_cast<int>(block), triangle, b);
}

OnBlock SurfaceMap::on_flat(std::size_t p, const trace::SurfacePoint& point) const {
  const PlacedMesh& part = room_.parts[p];
  const Chart& chart = charts_[p];
  const std::array<double, 2> at = flat(part, point.at.floor, point.at.z);
  int cell[2];
  for (int c = 0; c < 2; ++c) cell[c] = std::clamp(static_cast<int>(std::floor((at[c] - chart.low[c]) / chart.size[c])), 0, chart.cells - 1);
  double best = -0.05;  // how far outside a triangle it may lie: panels end where frames begin
  OnBlock found;
  for (const std::uint32_t t : chart.triangles[static_cast<std::size_t>(cell[1] * chart.cells + cell[0])]) {
    std::array<std::array<double, 2>, 3> q;
    for (std::size_t k = 0; k < 3; ++k) q[k] = flat(part, part.floor[part.triangles[t][k]], part.z[part.triangles[t][k]]);
    const auto area = [](const std::array<double, 2>& a, const std::array<double, 2>& b, const std::array<double, 2>& c) {
      return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    };
    const double all = area(q[0], q[1], q[2]);
    if (!(std::fabs(all) > 1e-30)) continue;
    const std::array<double, 3> b{area(at, q[1], q[2]) / all, area(q[0], at, q[2]) / all, area(q[0], q[1], at) / all};
    const double inside = std::min({b[0], b[1], b[2]});
    if (inside <= best) continue;
    best = inside;
    found = on_triangle(p, t, b);
    if (inside >= 0) break;
  }
  return found;
}

OnBlock SurfaceMap::find(const trace::SurfacePoint& point, const trace::Hit& hit) const {
  if (hit.target == trace::Target::triangle)
    return on_triangle(static_cast<std::size_t>(hit.part), static_cast<std::size_t>(hit.triangle), {hit.b[0], hit.b[1], hit.b[2]});
  const std::size_t flat = hit.target == trace::Target::floor ? 0 : hit.target == trace::Target::ceiling ? 1 : 2 + static_cast<std::size_t>(hit.wall);
  for (const std::size_t p : flats_[flat])
    if (const OnBlock found = on_flat(p, point); found.block >= 0) return found;
  return {};
}

}  // namespace orbc::light
