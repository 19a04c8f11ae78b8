#include "compiler/place/stitch.h"

#include <cmath>
#include <iterator>
#include <map>
#include <optional>

#include "compiler/place/panels.h"

namespace orbc::place {
namespace {

using geometry::Position;

constexpr double kEqualLengthTolerance = 1e-9;  // of the room's size

/// An edge of the room that panels share: the foot or head of a wall, with the arc length as parameter, or the vertical edge where a wall
/// starts, with the height as parameter.
struct SharedEdge {
  const room::Room* room = nullptr;
  int wall = 0;
  bool vertical = false;
  double z = 0;
  double tolerance = kEqualLengthTolerance;

  /// The parameter of a vertex, if it lies on the edge.
  [[nodiscard]] std::optional<double> parameter(const PlacedMesh& mesh, std::uint32_t v) const {
    const geometry::Point& x = mesh.floor[v];
    if (vertical) {
      const geometry::Point& start = room->walls[wall].start;
      if (std::fabs(x.w - start.w) + std::fabs(x.x - start.x) + std::fabs(x.y - start.y) > tolerance * (1 + std::fabs(x.w)))
        return std::nullopt;
      return mesh.z[v];
    }
    if (std::fabs(mesh.z[v] - z) > tolerance || std::fabs(geometry::signed_distance(room->space, room->walls[wall].line, x)) > tolerance)
      return std::nullopt;
    return arc_on_wall(*room, wall, x);
  }
  /// The affine coordinate t of the point with parameter p on the segment from parameter a (t = 0) to b (t = 1).
  [[nodiscard]] double affine_coordinate(double a, double b, double p) const {
    if (vertical) return (p - a) / (b - a);
    const double before = geometry::sin_k(room->space, p - a), after = geometry::sin_k(room->space, b - p);
    return before / (before + after);
  }
  /// The length of a closed wall, whose end is its start; else 0.
  [[nodiscard]] double period() const { return !vertical && room->corners.empty() ? room->walls[wall].length : 0; }
};

using PointsByParameter = std::map<double, Position>;

PointsByParameter::iterator find(PointsByParameter& points, double p, double tolerance) {
  const auto at = points.lower_bound(p - tolerance);
  return at != points.end() && at->first <= p + tolerance ? at : points.end();
}

// The parameters of a triangle edge's ends. Across the start of a closed wall, the smaller one is increased by the period.
struct EdgeInterval {
  double from = 0, to = 0;
};

EdgeInterval interval_of(const SharedEdge& edge, double a, double b) {
  const double period = edge.period();
  if (period > 0 && std::fabs(a - b) > period / 2) (a < b ? a : b) += period;
  return {a, b};
}

// Adds the vertices of a panel that lie on the edge, and replaces them by equal points that are known.
void snap_to_edge(const SharedEdge& edge, PlacedMesh& mesh, PointsByParameter& points) {
  for (std::uint32_t v = 0; v < mesh.floor.size(); ++v) {
    const auto p = edge.parameter(mesh, v);
    if (!p) continue;
    const double key = edge.period() > 0 && *p > edge.period() - edge.tolerance ? 0 : *p;
    auto at = find(points, key, edge.tolerance);
    if (at == points.end()) at = points.emplace(key, Position{mesh.floor[v], edge.vertical ? mesh.z[v] : edge.z}).first;
    mesh.floor[v] = at->second.floor;
    mesh.z[v] = at->second.z;
  }
}

// Adds the vertex `at`, which lies at (1−t)·a + t·b on a triangle edge. Makes: its index.
std::uint32_t insert(PlacedMesh& mesh, const Position& at, std::uint32_t a, std::uint32_t b, float t) {
  mesh.floor.push_back(at.floor);
  mesh.z.push_back(at.z);
  if (!mesh.uv.empty()) mesh.uv.push_back({(1 - t) * mesh.uv[a][0] + t * mesh.uv[b][0], (1 - t) * mesh.uv[a][1] + t * mesh.uv[b][1]});
  return static_cast<std::uint32_t>(mesh.floor.size() - 1);
}

// Splits the triangles of a panel at the points on their edges.
void divide(const SharedEdge& edge, PlacedMesh& mesh, const PointsByParameter& points) {
  std::vector<std::optional<double>> parameter;
  for (std::uint32_t v = 0; v < mesh.floor.size(); ++v) parameter.push_back(edge.parameter(mesh, v));
  std::vector<mesh::Triangle> triangles;
  std::vector<std::uint16_t> style;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const mesh::Triangle t = mesh.triangles[i];
    std::vector<std::uint32_t> border;
    int k = 0;
    while (k < 3 && !(parameter[t[k]] && parameter[t[(k + 1) % 3]])) ++k;
    if (k < 3) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      const EdgeInterval interval = interval_of(edge, *parameter[a], *parameter[b]);
      const double low = std::fmin(interval.from, interval.to) + edge.tolerance,
                   high = std::fmax(interval.from, interval.to) - edge.tolerance;
      std::map<double, Position> between;
      for (const double shift : {0.0, edge.period()}) {
        for (auto at = points.lower_bound(low - shift); at != points.end() && at->first < high - shift; ++at)
          between.emplace(at->first + shift, at->second);
        if (edge.period() == 0) break;
      }
      for (const auto& [p, at] : between)
        border.push_back(insert(mesh, at, a, b, static_cast<float>(edge.affine_coordinate(interval.from, interval.to, p))));
      if (interval.from > interval.to) border = {border.rbegin(), border.rend()};
      border.insert(border.begin(), a);
      border.push_back(b);
    }
    if (border.size() < 3) {
      triangles.push_back(t);
      style.push_back(mesh.style[i]);
      continue;
    }
    for (std::size_t j = 0; j + 1 < border.size(); ++j) {
      triangles.push_back({border[j], border[j + 1], t[(k + 2) % 3]});
      style.push_back(mesh.style[i]);
    }
  }
  mesh.triangles = std::move(triangles);
  mesh.style = std::move(style);
}

}  // namespace

std::vector<PlacedMesh> stitch_panels(const room::Room& room, double height, std::vector<PlacedMesh> panels) {
  const int n = static_cast<int>(room.walls.size());
  const double tolerance = kEqualLengthTolerance * std::fmin(room.circumradius, height);
  const auto stitch = [&panels](const SharedEdge& edge, const auto& belongs) {
    PointsByParameter points;
    for (PlacedMesh& panel : panels)
      if (belongs(panel)) snap_to_edge(edge, panel, points);
    for (PlacedMesh& panel : panels)
      if (belongs(panel)) divide(edge, panel, points);
  };
  for (int i = 0; i < n; ++i) {
    stitch({&room, i, false, 0, tolerance},
        [i](const PlacedMesh& p) { return p.kind == PartKind::floor || (p.kind == PartKind::wall && p.wall == i); });
    stitch({&room, i, false, height, tolerance},
        [i](const PlacedMesh& p) { return p.kind == PartKind::ceiling || (p.kind == PartKind::wall && p.wall == i); });
    stitch({&room, i, true, 0, tolerance},
        [i, n](const PlacedMesh& p) { return p.kind == PartKind::wall && (p.wall == i || p.wall == (i + n - 1) % n); });
  }
  return panels;
}

}  // namespace orbc::place
