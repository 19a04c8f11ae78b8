// Edges once each, by bucket of the smaller end; the bounds of a part that let most copies pass without looking at a single edge.
//
// The bound: a geodesic parametrised by arc length, seen in the log chart (polar coordinates r, φ; sinκ²(r)φ' = const), has
// the acceleration
//   radial (sinκ cosκ − r)/sinκ² · sin²ψ,   transverse (sinκ − r cosκ)/sinκ² · sin 2ψ      (ψ = angle to the radius)
// so a chord of length ℓ is off by at most Kℓ²/8, and a triangle by Kℓ²/6. The height is affine in b, not in the arc: b differs from s/ℓ by
// ½(tanκ(ℓu/2)/tanκ(ℓ/2) − u), at most ℓ²/50 for ℓ ≤ 1. In the conformal chart |C''| ≤ 1.5|z|(1 + κ|z|²).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/bend/tessellate.h"

namespace orbc::bend {

using geometry::Space;

namespace {

void collect_edges(const place::PlacedMesh& mesh, PartNet& net) {
  const std::size_t vertices = mesh.floor.size();
  // Edges by their smaller end: a chain for every vertex.
  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> head(vertices, kNone), next;
  net.triangle_edges.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    std::array<std::uint32_t, 3> ids{};
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = std::min(t[k], t[(k + 1) % 3]), b = std::max(t[k], t[(k + 1) % 3]);
      std::uint32_t id = head[a];
      while (id != kNone && net.edges[id][1] != b) id = next[id];
      if (id == kNone) {
        id = static_cast<std::uint32_t>(net.edges.size());
        net.edges.push_back({a, b});
        next.push_back(head[a]);
        head[a] = id;
      }
      ids[k] = id;
    }
    net.triangle_edges.push_back(ids);
  }
}

double bound_of_eye(const CopyMap& map, const Sight& sight, const PartNet& net, double from, double to) {
  const double l2 = net.longest * net.longest, k = acceleration(map, from, to);
  const double reach = map.log.sheet > 0 ? map.log.sheet * std::numbers::pi : from;
  const double level = std::max({0.0, net.low - sight.eye.z, sight.eye.z - net.high}), near = math::hypot(reach, level);
  if (near < 1e-6 || k == kCannotTell) return kCannotTell;
  double off = k * l2 / 6 + l2 / 50 * net.steepest;
  if (net.along > 0) off = std::max(off, (k * l2 / 6 + l2 / 50 * (net.steepest + net.longest)) / net.along);
  return off / near * densest(sight) / sight.tolerance;
}

}  // namespace

double acceleration(const CopyMap& map, double from, double to) {
  if (map.log.space == Space::euclidean) return 0;
  if (map.log.space == Space::hyperbolic) return math::hypot(std::min(1.0, 2 * to / 3), std::min(0.32, to / 3));
  if (map.log.sheet == 0 && to <= std::numbers::pi / 2) return to * math::hypot(1, 0.64);
  const bool torn_below = map.log.sheet > 0;
  if (to > std::numbers::pi - 1e-3 || (torn_below && from < 1e-3)) return kCannotTell;
  // sin is smallest at one of the ends.
  const double s = torn_below ? std::min(math::sin(from), math::sin(to)) : math::sin(to);
  const double largest = torn_below ? (map.log.sheet + 1) * std::numbers::pi : to;
  return math::hypot(0.5 + largest, 1 + largest) / (s * s);
}

PartNet part_net(Space space, const place::PlacedMesh& mesh, double along) {
  PartNet net;
  net.mesh = &mesh;
  net.along = along;
  geometry::Ambient sum{0, 0, 0};
  net.low = mesh.z.empty() ? 0 : mesh.z[0];
  net.high = net.low;
  for (std::size_t i = 0; i < mesh.floor.size(); ++i) {
    net.points.w.push_back(mesh.floor[i].w);
    net.points.x.push_back(mesh.floor[i].x);
    net.points.y.push_back(mesh.floor[i].y);
    net.points.z.push_back(static_cast<float>(mesh.z[i]));
    sum = sum + mesh.floor[i];
    net.low = std::min(net.low, mesh.z[i]);
    net.high = std::max(net.high, mesh.z[i]);
  }
  // On S² the points may balance each other (a whole equator): any centre will do.
  if (space != Space::spherical || sum.w * sum.w + sum.x * sum.x + sum.y * sum.y > 1e-6)
    net.centre = geometry::normalised_point(space, sum);
  if (mesh.floor.empty()) net.centre = {};
  for (const auto& p : mesh.floor) net.radius = std::max(net.radius, geometry::distance(space, net.centre, p));
  collect_edges(mesh, net);
  for (const auto& [a, b] : net.edges) {
    net.longest = std::max(net.longest, geometry::distance(space, mesh.floor[a], mesh.floor[b]));
    net.steepest = std::max(net.steepest, std::fabs(mesh.z[a] - mesh.z[b]));
  }
  return net;
}

double error_bound(const CopyMap& map, const Sight& sight, const PartNet& net) {
  if (map.log.space == Space::euclidean) return 0;
  if (net.longest > 1) return kCannotTell;
  const geometry::Ambient c = map.log.eye_from_copy * net.centre;
  const double d = geometry::arc_k(map.log.space, c.w, math::hypot(c.x, c.y));
  const double from = std::max(0.0, d - net.radius), to = d + net.radius;
  if (map.view == View::eye) return bound_of_eye(map, sight, net, from, to);
  const double l2 = net.longest * net.longest;
  double k = 0.58;
  if (map.log.space == Space::spherical) {
    if (to > 3) return kCannotTell;
    const double z = math::tan(to / 2);
    k = 1.5 * z * (1 + z * z);
  }
  return (k * l2 / 6 + l2 / 50 * (net.steepest + net.longest)) / sight.tolerance;
}

}  // namespace orbc::bend
