#include "compiler/surface/normals.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "compiler/base/elementary.h"
#include "compiler/surface/tangent_frame.h"
#include "compiler/trace/analytic.h"

namespace orbc::surface {
namespace {

using geometry::Ambient;
using geometry::Space;
using geometry::Vector3;
using place::PartKind;
using place::PlacedMesh;

// The normal of a triangle in the frame of its corner k, with the angle at that corner as its length.
Vector3 corner_normal(Space space, const TangentFrame& frame, const PlacedMesh& mesh, const mesh::Triangle& t, int k) {
  const std::uint32_t v = t[k], p = t[(k + 1) % 3], q = t[(k + 2) % 3];
  const auto edge = [&](std::uint32_t to) { return to_local(space, frame, {mesh.floor[to] - mesh.floor[v], mesh.z[to] - mesh.z[v]}); };
  const Vector3 a = edge(p), b = edge(q), n = cross(a, b);
  const double area = length(n);
  if (!(area > 1e-30)) return {0, 0, 0};
  return (math::atan2(area, dot(a, b)) / area) * n;
}

bool same_position(const PlacedMesh& mesh, std::uint32_t a, std::uint32_t b) {
  return mesh.floor[a].w == mesh.floor[b].w && mesh.floor[a].x == mesh.floor[b].x && mesh.floor[a].y == mesh.floor[b].y &&
         mesh.z[a] == mesh.z[b];
}

/// Corner k of a triangle.
struct Corner {
  std::uint32_t triangle = 0;
  int k = 0;
};

// The unit normals of the corners at one position: each is the sum of the normals there that lie within the crease angle of its own.
std::vector<Vector3> position_normals(Space space, const PlacedMesh& mesh, const TangentFrame& frame, const std::vector<Corner>& here,
                                      double cos_crease) {
  std::vector<Vector3> weighted, normals;
  for (const Corner& c : here) weighted.push_back(corner_normal(space, frame, mesh, mesh.triangles[c.triangle], c.k));
  for (const Vector3& own : weighted) {
    Vector3 sum{0, 0, 0};
    const double own_length = length(own);
    for (const Vector3& other : weighted) {
      const double other_length = length(other);
      if (other_length > 0 && (own_length == 0 || dot(own, other) >= cos_crease * own_length * other_length)) sum = sum + other;
    }
    const double size = length(sum);
    normals.push_back(size > 1e-12 ? (1 / size) * sum : Vector3{0, 0, 1});
  }
  return normals;
}

bool equal(const Vector3& a, const Vector3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/// The corners of a mesh, ordered by the vertex they belong to.
struct VertexCorners {
  std::vector<std::uint32_t> start;  ///< per vertex, and the end: into `corners`
  std::vector<Corner> corners;
};

VertexCorners vertex_corners(const PlacedMesh& mesh) {
  VertexCorners result;
  result.start.assign(mesh.floor.size() + 1, 0);
  for (const mesh::Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) ++result.start[v + 1];
  std::partial_sum(result.start.begin(), result.start.end(), result.start.begin());
  result.corners.resize(result.start.back());
  std::vector<std::uint32_t> next(result.start.begin(), result.start.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) result.corners[next[mesh.triangles[t][k]]++] = {t, k};
  return result;
}

// Vertices at equal positions (seams of uv) come one after another.
std::vector<std::uint32_t> vertices_by_position(const PlacedMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.floor.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](std::uint32_t v) { return std::tuple(mesh.floor[v].w, mesh.floor[v].x, mesh.floor[v].y, mesh.z[v], v); };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  return order;
}

PartNormals smooth_normals(Space space, const PlacedMesh& mesh, double cos_crease) {
  PartNormals result;
  result.corners.resize(mesh.triangles.size());
  const VertexCorners all = vertex_corners(mesh);
  const std::vector<std::uint32_t> order = vertices_by_position(mesh);
  for (std::size_t i = 0; i < order.size();) {
    std::vector<Corner> here;
    std::size_t j = i;
    for (; j < order.size() && same_position(mesh, order[i], order[j]); ++j)
      here.insert(here.end(), all.corners.begin() + all.start[order[j]], all.corners.begin() + all.start[order[j] + 1]);
    const TangentFrame frame = tangent_frame(space, mesh.floor[order[i]]);
    i = j;
    const std::vector<Vector3> normals = position_normals(space, mesh, frame, here, cos_crease);
    const std::size_t first = result.vertices.size();
    std::vector<Vector3> distinct;  // of result.vertices from `first` on
    for (std::size_t c = 0; c < here.size(); ++c) {
      const std::uint32_t vertex = mesh.triangles[here[c].triangle][here[c].k];
      std::size_t n = 0;
      while (n < distinct.size() && !(result.vertices[first + n].vertex == vertex && equal(distinct[n], normals[c]))) ++n;
      if (n == distinct.size()) {
        result.vertices.push_back({vertex, to_ambient(frame, normals[c])});
        distinct.push_back(normals[c]);
      }
      result.corners[here[c].triangle][here[c].k] = static_cast<std::uint32_t>(first + n);
    }
  }
  return result;
}

// Moves a point that lies on a border of the room inside. Frames end on walls, and a ray that starts beyond a mirror by a rounding error
// would be reflected there at once.
geometry::Position move_inside(const place::Interior& interior, geometry::Position at) {
  const double k = geometry::curvature(interior.polygon.space);
  for (const room::Wall& wall : interior.polygon.walls)
    if (const double depth = geometry::value_at(wall.line, at.floor); depth < trace::kRayEpsilon)
      at.floor = geometry::normalised_point(
          interior.polygon.space,
          geometry::Ambient(at.floor) + (trace::kRayEpsilon - depth) * Ambient{k * wall.line.w, wall.line.x, wall.line.y});
  at.z = std::clamp(at.z, trace::kRayEpsilon, interior.height - trace::kRayEpsilon);
  return at;
}

}  // namespace

PartNormals part_normals(const place::Interior& interior, const PlacedMesh& part, double crease) {
  const Space space = interior.polygon.space;
  if (part.kind == PartKind::object || part.kind == PartKind::frame) return smooth_normals(space, part, math::cos(crease));
  PartNormals result;
  trace::Direction normal{{0, 0, 0}, part.kind == PartKind::ceiling ? -1.0 : 1.0};
  if (part.kind == PartKind::wall) normal = trace::normal_of_wall(space, interior.polygon.walls[static_cast<std::size_t>(part.wall)]);
  for (std::uint32_t v = 0; v < part.floor.size(); ++v) result.vertices.push_back({v, normal});
  result.corners.assign(part.triangles.begin(), part.triangles.end());
  return result;
}

ShadingPoint shading_point(const place::Interior& interior, const PlacedMesh& part, const ShadingVertex& vertex) {
  ShadingPoint point;
  point.at = point.ray_origin = {part.floor[vertex.vertex], part.z[vertex.vertex]};
  point.normal = point.geometric_normal = vertex.normal;
  point.wall = part.kind == PartKind::wall ? part.wall : -1;
  point.on_triangle = part.kind == PartKind::object || part.kind == PartKind::frame;
  if (point.on_triangle) point.ray_origin = move_inside(interior, point.ray_origin);
  return point;
}

ShadingPoint shading_point(const place::Interior& interior, const PlacedMesh& part, const PartNormals& normals, std::size_t triangle,
                           const std::array<double, 3>& b) {
  const Space space = interior.polygon.space;
  const mesh::Triangle& t = part.triangles[triangle];
  ShadingPoint point;
  const Ambient sum = b[0] * part.floor[t[0]] + b[1] * part.floor[t[1]] + b[2] * part.floor[t[2]];
  point.at = {geometry::normalised_point(space, sum), b[0] * part.z[t[0]] + b[1] * part.z[t[1]] + b[2] * part.z[t[2]]};
  point.ray_origin = point.at;
  point.wall = part.kind == PartKind::wall ? part.wall : -1;
  point.on_triangle = part.kind == PartKind::object || part.kind == PartKind::frame;
  if (!point.on_triangle) {
    point.normal = point.geometric_normal = normals.vertices[normals.corners[triangle][0]].normal;
    return point;
  }
  const TangentFrame frame = tangent_frame(space, point.at.floor);
  Vector3 n[3], normal{0, 0, 0}, lift{0, 0, 0};
  for (int k = 0; k < 3; ++k) {
    n[k] = to_local(space, frame, normals.vertices[normals.corners[triangle][k]].normal);
    normal = normal + b[k] * n[k];
  }
  const double size = length(normal);
  point.normal = point.geometric_normal = to_ambient(frame, size > 1e-9 ? (1 / size) * normal : n[0]);
  // The derivative of normalise(Σ bᵢXᵢ) by b is the edge divided by |Σ bᵢXᵢ|.
  const double k2 = geometry::curvature(space);
  const double norm = space == Space::euclidean ? 1 : std::sqrt(std::fabs(sum.w * sum.w + k2 * (sum.x * sum.x + sum.y * sum.y)));
  const auto edge = [&](int k) {
    return to_local(space, frame, {(1 / norm) * (part.floor[t[k]] - part.floor[t[0]]), part.z[t[k]] - part.z[t[0]]});
  };
  const Vector3 across = cross(edge(1), edge(2));
  if (const double area = length(across); area > 1e-30) point.geometric_normal = to_ambient(frame, (1 / area) * across);
  for (int k = 0; k < 3; ++k) {
    const Vector3 from = to_local(space, frame, {point.at.floor - part.floor[t[k]], point.at.z - part.z[t[k]]});
    const double below = std::min(0.0, dot(from, n[k]));
    lift = lift - (b[k] * below) * n[k];
  }
  point.ray_origin = move_inside(interior, exponential(space, point.at, frame, lift));
  return point;
}

}  // namespace orbc::surface
