// Splits convex polygons by lines in homogeneous coordinates (Sutherland, Hodgman 1974). A line is a linear form on ambient vectors, so
// points at infinity of the gnomonic chart (the boundary of a hemisphere, w = 0) need no division and no special case.
#include "compiler/place/polygon_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace orbc::place {
namespace {

using geometry::Position;

std::uint32_t interpolated_vertex(geometry::Space space, PolygonMesh& surface, std::uint32_t a, std::uint32_t b, double t) {
  const Position p = surface.vertices[a], q = surface.vertices[b];
  surface.vertices.push_back({geometry::normalised_point(space, (1 - t) * p.floor + t * q.floor), (1 - t) * p.z + t * q.z});
  return static_cast<std::uint32_t>(surface.vertices.size() - 1);
}

std::uint32_t add_centre(geometry::Space space, PolygonMesh& surface, const PolygonMesh::Polygon& polygon) {
  geometry::Ambient sum{0, 0, 0};
  double z = 0;
  for (const PolygonMesh::Edge& edge : polygon.loop) {
    sum = sum + surface.vertices[edge.vertex].floor;
    z += surface.vertices[edge.vertex].z;
  }
  surface.vertices.push_back({geometry::normalised_point(space, sum), z / static_cast<double>(polygon.loop.size())});
  return static_cast<std::uint32_t>(surface.vertices.size() - 1);
}

}  // namespace

SplitResult split_by(const std::vector<PolygonMesh::Polygon>& polygons, int side, const std::function<double(std::uint32_t)>& value,
              const std::function<std::uint32_t(std::uint32_t, std::uint32_t, double)>& make) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> crossings;
  const auto crossing_vertex = [&](std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto known = crossings.find({a, b});
    if (known != crossings.end()) return known->second;
    const double p = value(a), q = value(b);
    return crossings[{a, b}] = make(a, b, p / (p - q));
  };
  SplitResult split;
  for (const PolygonMesh::Polygon& polygon : polygons) {
    const std::size_t n = polygon.loop.size();
    std::vector<double> values(n);
    bool any_left = false, any_right = false;
    for (std::size_t i = 0; i < n; ++i) {
      values[i] = value(polygon.loop[i].vertex);
      any_left = any_left || values[i] > 0;
      any_right = any_right || values[i] < 0;
    }
    if (!any_right) {
      split.left.push_back(polygon);
      continue;
    }
    if (!any_left) {
      split.right.push_back(polygon);
      continue;
    }
    PolygonMesh::Polygon left{{}, polygon.label}, right{{}, polygon.label};
    for (std::size_t i = 0; i < n; ++i) {
      const PolygonMesh::Edge& edge = polygon.loop[i];
      const double here = values[i], next = values[(i + 1) % n];
      // The vertex itself. Where the loop leaves a part for the other one, the part's boundary continues along the cut.
      if (here >= 0) left.loop.push_back({edge.vertex, here == 0 && next < 0 ? side : edge.side});
      if (here <= 0) right.loop.push_back({edge.vertex, here == 0 && next > 0 ? side : edge.side});
      if (here * next < 0) {
        const std::uint32_t middle = crossing_vertex(edge.vertex, polygon.loop[(i + 1) % n].vertex);
        left.loop.push_back({middle, here > 0 ? side : edge.side});
        right.loop.push_back({middle, here > 0 ? edge.side : side});
      }
    }
    split.left.push_back(std::move(left));
    split.right.push_back(std::move(right));
  }
  return split;
}

SplitResult split_by_line(geometry::Space space, PolygonMesh& surface, const std::vector<PolygonMesh::Polygon>& polygons,
                          const geometry::Line& line, int side) {
  const auto value = [&](std::uint32_t i) {
    const geometry::Ambient& x = surface.vertices[i].floor;
    const double size = std::fmax(std::fabs(line.w * x.w), std::fmax(std::fabs(x.x), std::fabs(x.y))), v = geometry::value_at(line, x);
    return std::fabs(v) <= 1e-12 * size ? 0 : v;
  };
  return split_by(polygons, side, value,
                  [&](std::uint32_t a, std::uint32_t b, double t) { return interpolated_vertex(space, surface, a, b, t); });
}

SplitResult split_at_height(geometry::Space space, PolygonMesh& surface, const std::vector<PolygonMesh::Polygon>& polygons, double z,
                            int side) {
  const auto value = [&](std::uint32_t i) {
    const double v = surface.vertices[i].z - z;
    return std::fabs(v) <= 1e-12 * (std::fabs(surface.vertices[i].z) + std::fabs(z)) ? 0 : v;
  };
  return split_by(polygons, side, value,
                  [&](std::uint32_t a, std::uint32_t b, double t) { return interpolated_vertex(space, surface, a, b, t); });
}

std::vector<mesh::Triangle> fan(const PolygonMesh::Polygon& polygon, std::uint32_t hub) {
  std::vector<mesh::Triangle> triangles;
  const std::size_t n = polygon.loop.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t a = polygon.loop[i].vertex, b = polygon.loop[(i + 1) % n].vertex;
    if (a != hub && b != hub) triangles.push_back({hub, a, b});
  }
  return triangles;
}

std::vector<mesh::Triangle> triangulate(geometry::Space space, PolygonMesh& surface, const PolygonMesh::Polygon& polygon) {
  const std::vector<PolygonMesh::Edge>& loop = polygon.loop;
  const std::size_t n = loop.size();
  std::map<int, int> edges_of_side;
  for (const PolygonMesh::Edge& edge : loop) ++edges_of_side[edge.side];
  // A triangle of the fan is degenerate if its edge lies on a side of the hub. So the hub's sides must contain no edges but its own two.
  for (std::size_t i = 0; i < n; ++i) {
    const int before = loop[(i + n - 1) % n].side, after = loop[i].side;
    const int own = before == after ? 2 : 1;
    if (edges_of_side[before] == own && edges_of_side[after] == own) return fan(polygon, loop[i].vertex);
  }
  return fan(polygon, add_centre(space, surface, polygon));
}

}  // namespace orbc::place
