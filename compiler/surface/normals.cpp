#include "compiler/surface/normals.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "compiler/base/elementary.h"
#include "compiler/surface/frame.h"
#include "compiler/trace/analytic.h"

namespace orbc::surface {
namespace {

using geometry::Ambient;
using geometry::Space;
using geometry::Vector3;
using place::PartKind;
using place::PlacedMesh;

// Corner k of a triangle in the frame of its vertex: its normal, weighted by the angle there (Thürmer, Wüthrich 1998).
Vector3 corner_normal(Space space, const Frame& frame, const PlacedMesh& mesh, const mesh::Triangle& t, int k) {
  const std::uint32_t v = t[k], p = t[(k + 1) % 3], q = t[(k + 2) % 3];
  const auto edge = [&](std::uint32_t to) { return local(space, frame, {mesh.floor[to] - mesh.floor[v], mesh.z[to] - mesh.z[v]}); };
  const Vector3 a = edge(p), b = edge(q), n = cross(a, b);
  const double area = length(n);
  if (!(area > 1e-30)) return {0, 0, 0};
  return (math::atan2(area, dot(a, b)) / area) * n;
}

bool same_place(const PlacedMesh& mesh, std::uint32_t a, std::uint32_t b) {
  return mesh.floor[a].w == mesh.floor[b].w && mesh.floor[a].x == mesh.floor[b].x && mesh.floor[a].y == mesh.floor[b].y &&
         mesh.z[a] == mesh.z[b];
}

struct Corner {
  std::uint32_t triangle = 0;
  int k = 0;
  Vector3 normal;  ///< weighted
};

// The corners that meet in one place: each gets the sum over those within the crease angle of its own triangle.
void smooth_place(Space space, const PlacedMesh& mesh, const Frame& frame, std::vector<Corner>& here, double cos_crease,
                  PartNormals& result) {
  for (Corner& c : here) c.normal = corner_normal(space, frame, mesh, mesh.triangles[c.triangle], c.k);
  struct Known {
    std::uint32_t vertex, id;
    Vector3 normal;
  };
  std::vector<Known> known;
  for (const Corner& c : here) {
    Vector3 sum{0, 0, 0};
    const double own = length(c.normal);
    for (const Corner& other : here) {
      const double size = length(other.normal);
      if (size > 0 && (own == 0 || dot(c.normal, other.normal) >= cos_crease * own * size)) sum = sum + other.normal;
    }
    const double size = length(sum);
    const Vector3 normal = size > 1e-12 ? (1 / size) * sum : Vector3{0, 0, 1};
    const std::uint32_t vertex = mesh.triangles[c.triangle][c.k];
    const auto at = std::find_if(known.begin(), known.end(), [&](const Known& k) {
      return k.vertex == vertex && k.normal.x == normal.x && k.normal.y == normal.y && k.normal.z == normal.z;
    });
    if (at != known.end()) {
      result.corners[c.triangle][c.k] = at->id;
      continue;
    }
    const auto id = static_cast<std::uint32_t>(result.vertices.size());
    result.vertices.push_back({vertex, global(frame, normal)});
    result.corners[c.triangle][c.k] = id;
    known.push_back({vertex, id, normal});
  }
}

PartNormals of_object(Space space, const PlacedMesh& mesh, double cos_crease) {
  PartNormals result;
  result.corners.resize(mesh.triangles.size());
  std::vector<std::uint32_t> start(mesh.floor.size() + 1, 0);
  for (const mesh::Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) ++start[v + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<Corner> corners(start.back());
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) corners[next[mesh.triangles[t][k]]++] = {t, k, {}};
  std::vector<std::uint32_t> order(mesh.floor.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](std::uint32_t v) { return std::tuple(mesh.floor[v].w, mesh.floor[v].x, mesh.floor[v].y, mesh.z[v], v); };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<Corner> here;
  for (std::size_t i = 0; i < order.size();) {
    here.clear();
    std::size_t j = i;
    for (; j < order.size() && same_place(mesh, order[i], order[j]); ++j)
      here.insert(here.end(), corners.begin() + start[order[j]], corners.begin() + start[order[j] + 1]);
    if (!here.empty()) smooth_place(space, mesh, frame_at(space, mesh.floor[order[i]]), here, cos_crease, result);
    i = j;
  }
  return result;
}

// Frames and beams end on walls, and rays that start a rounding beyond a mirror would be turned back by it at once.
geometry::Position inside(const place::PlacedRoom& room, geometry::Position at) {
  const double k = geometry::curvature(room.room.space);
  for (const room::Wall& wall : room.room.walls)
    if (const double left = geometry::value_at(wall.line, at.floor); left < trace::kLeave)
      at.floor = geometry::normalised_point(
          room.room.space, geometry::Ambient(at.floor) + (trace::kLeave - left) * Ambient{k * wall.line.w, wall.line.x, wall.line.y});
  at.z = std::clamp(at.z, trace::kLeave, room.height - trace::kLeave);
  return at;
}

}  // namespace

PartNormals part_normals(const place::PlacedRoom& room, const PlacedMesh& part, double crease) {
  const Space space = room.room.space;
  if (part.kind == PartKind::object || part.kind == PartKind::frame) return of_object(space, part, math::cos(crease));
  PartNormals result;
  trace::Direction normal{{0, 0, 0}, part.kind == PartKind::ceiling ? -1.0 : 1.0};
  if (part.kind == PartKind::wall) normal = trace::normal_of_wall(space, room.room.walls[static_cast<std::size_t>(part.wall)]);
  for (std::uint32_t v = 0; v < part.floor.size(); ++v) result.vertices.push_back({v, normal});
  result.corners.assign(part.triangles.begin(), part.triangles.end());
  return result;
}

LightPoint light_point(const place::PlacedRoom& room, const PlacedMesh& part, const ShadingVertex& vertex) {
  LightPoint point;
  point.at = point.origin = {part.floor[vertex.vertex], part.z[vertex.vertex]};
  point.normal = point.flat = vertex.normal;
  point.wall = part.kind == PartKind::wall ? part.wall : -1;
  point.on_triangle = part.kind == PartKind::object || part.kind == PartKind::frame;
  if (point.on_triangle) point.origin = inside(room, point.origin);
  return point;
}

LightPoint light_point(const place::PlacedRoom& room, const PlacedMesh& part, const PartNormals& normals, std::size_t triangle,
                       const std::array<double, 3>& b) {
  const Space space = room.room.space;
  const mesh::Triangle& t = part.triangles[triangle];
  LightPoint point;
  const Ambient sum = b[0] * part.floor[t[0]] + b[1] * part.floor[t[1]] + b[2] * part.floor[t[2]];
  point.at = {geometry::normalised_point(space, sum), b[0] * part.z[t[0]] + b[1] * part.z[t[1]] + b[2] * part.z[t[2]]};
  point.origin = point.at;
  point.wall = part.kind == PartKind::wall ? part.wall : -1;
  point.on_triangle = part.kind == PartKind::object || part.kind == PartKind::frame;
  if (!point.on_triangle) {
    point.normal = point.flat = normals.vertices[normals.corners[triangle][0]].normal;
    return point;
  }
  const Frame frame = frame_at(space, point.at.floor);
  Vector3 n[3], normal{0, 0, 0}, lift{0, 0, 0};
  for (int k = 0; k < 3; ++k) {
    n[k] = local(space, frame, normals.vertices[normals.corners[triangle][k]].normal);
    normal = normal + b[k] * n[k];
  }
  const double size = length(normal);
  point.normal = point.flat = global(frame, size > 1e-9 ? (1 / size) * normal : n[0]);
  // ∂/∂b of normalise(Σ bᵢXᵢ) has the length of the edge over |Σ bᵢXᵢ|.
  const double k2 = geometry::curvature(space);
  const double sagged = space == Space::euclidean ? 1 : std::sqrt(std::fabs(sum.w * sum.w + k2 * (sum.x * sum.x + sum.y * sum.y)));
  const auto edge = [&](int k) {
    return local(space, frame, {(1 / sagged) * (part.floor[t[k]] - part.floor[t[0]]), part.z[t[k]] - part.z[t[0]]});
  };
  const Vector3 across = cross(edge(1), edge(2));
  if (const double area = length(across); area > 1e-30) point.flat = global(frame, (1 / area) * across);
  for (int k = 0; k < 3; ++k) {
    const Vector3 from = local(space, frame, {point.at.floor - part.floor[t[k]], point.at.z - part.z[t[k]]});
    const double below = std::min(0.0, dot(from, n[k]));
    lift = lift - (b[k] * below) * n[k];
  }
  point.origin = inside(room, exponential(space, point.at, frame, lift));
  return point;
}

}  // namespace orbc::surface
