// An edge is found through a list of the edges that begin at its smaller vertex.
#include "compiler/bend/edge_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"

namespace orbc::bend {

using geometry::Space;

namespace {

EdgeMesh with_edges(EdgeMesh part) {
  const place::PlacedMesh& mesh = *part.mesh;
  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> head(mesh.floor.size(), kNone), next;
  part.triangle_edges.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    std::array<std::uint32_t, 3> ids{};
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = std::min(t[k], t[(k + 1) % 3]), b = std::max(t[k], t[(k + 1) % 3]);
      std::uint32_t id = head[a];
      while (id != kNone && part.edges[id][1] != b) id = next[id];
      if (id == kNone) {
        id = static_cast<std::uint32_t>(part.edges.size());
        part.edges.push_back({a, b});
        next.push_back(head[a]);
        head[a] = id;
      }
      ids[k] = id;
    }
    part.triangle_edges.push_back(ids);
  }
  return part;
}

double error_bound_for_eye(const CopyMap& map, const ScreenMetric& metric, const EdgeMesh& part, double from, double to) {
  const double l2 = part.max_length * part.max_length, k = acceleration_bound(map, from, to);
  const double path = map.log.sheet > 0 ? map.log.sheet * std::numbers::pi : from;
  const double rise = std::max({0.0, part.low - metric.eye.z, metric.eye.z - part.high}), near = math::hypot(path, rise);
  if (near < 1e-6 || k == kUnbounded) return kUnbounded;
  double off = k * l2 / 6 + l2 / 50 * part.max_rise;
  if (part.color_tolerance > 0) off = std::max(off, (k * l2 / 6 + l2 / 50 * (part.max_rise + part.max_length)) / part.color_tolerance);
  return off / near * max_pixels_per_radian(metric) / metric.tolerance;
}

}  // namespace

EdgeMesh edge_mesh(Space space, const place::PlacedMesh& mesh, double color_tolerance) {
  EdgeMesh part;
  part.mesh = &mesh;
  part.color_tolerance = color_tolerance;
  part.low = mesh.z.empty() ? 0 : mesh.z[0];
  part.high = part.low;
  for (std::size_t i = 0; i < mesh.floor.size(); ++i) {
    part.points.w.push_back(mesh.floor[i].w);
    part.points.x.push_back(mesh.floor[i].x);
    part.points.y.push_back(mesh.floor[i].y);
    part.points.z.push_back(static_cast<float>(mesh.z[i]));
    part.low = std::min(part.low, mesh.z[i]);
    part.high = std::max(part.high, mesh.z[i]);
  }
  part.circle = geometry::bounding_circle(space, mesh.floor);
  part = with_edges(std::move(part));
  for (const auto& [a, b] : part.edges) {
    part.max_length = std::max(part.max_length, geometry::distance(space, mesh.floor[a], mesh.floor[b]));
    part.max_rise = std::max(part.max_rise, std::fabs(mesh.z[a] - mesh.z[b]));
  }
  return part;
}

double error_bound(const CopyMap& map, const ScreenMetric& metric, const EdgeMesh& part) {
  if (map.log.space == Space::euclidean) return 0;
  if (part.max_length > 1) return kUnbounded;
  const geometry::Ambient c = map.log.eye_from_copy * part.circle.centre;
  const double d = geometry::arc_k(map.log.space, c.w, math::hypot(c.x, c.y));
  const double from = std::max(0.0, d - part.circle.radius), to = d + part.circle.radius;
  if (map.view == View::eye) return error_bound_for_eye(map, metric, part, from, to);
  if (metric.chart_eye) return kUnbounded;
  const double l2 = part.max_length * part.max_length;
  double k = 0.58;
  if (map.log.space == Space::spherical) {
    if (to > 3) return kUnbounded;
    const double z = math::tan(to / 2);
    k = 1.5 * z * (1 + z * z);
  }
  return (k * l2 / 6 + l2 / 50 * (part.max_rise + part.max_length)) / metric.tolerance;
}

}  // namespace orbc::bend
