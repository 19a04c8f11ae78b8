#include "compiler/bake/lit_part.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "compiler/base/elementary.h"
#include "compiler/light/connection.h"

namespace orbc::bake {

using scene::Color;

PointToLight point_to_light(const LitPart& part, std::size_t triangle, const std::array<double, 3>& b, double reach) {
  PointToLight asked{surface::shading_point(part.room, part.mesh, part.normals, triangle, b), {}};
  if (!part.surfaces) return asked;
  const light::SurfaceProjection foot = light::project_to_surface(part.lighting, asked.point, reach);
  asked.point = foot.point;
  if (const OnBlock on = part.surfaces->stood_for(foot.hit, part.mesh.look[triangle]); on.block >= 0)
    asked.known = light_at(part.lamps[static_cast<std::size_t>(on.block)], on.u, on.v);
  return asked;
}

std::uint64_t light_vertices(LitPart& part, const Executor& executor, const Progress& progress) {
  constexpr std::size_t kChunk = 32;
  // What glows is not lit.
  struct Corner {
    std::size_t triangle = 0, k = 3;
  };
  std::vector<Corner> lit(part.normals.vertices.size());
  for (std::size_t t = 0; t < part.mesh.triangles.size(); ++t)
    if (part.room.looks[part.mesh.look[t]].material.kind != scene::MaterialKind::emissive)
      for (std::size_t k = 0; k < 3; ++k)
        if (Corner& corner = lit[part.normals.corners[t][k]]; corner.k > 2) corner = {t, k};
  part.at_vertex.resize(part.normals.vertices.size());
  part.blind_vertex.assign(part.normals.vertices.size(), 0);
  std::atomic<std::uint64_t> done{0}, count{0};
  executor((part.at_vertex.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    const std::size_t end = std::min((chunk + 1) * kChunk, part.at_vertex.size());
    const auto position = [&](std::size_t i) {
      const std::uint32_t v = part.normals.vertices[i].vertex;
      return geometry::Position{part.mesh.floor[v], part.mesh.z[v]};
    };
    const geometry::Position centre = position(chunk * kChunk);
    double radius = 0;
    for (std::size_t i = chunk * kChunk; i < end; ++i) {
      const geometry::Position p = position(i);
      radius = std::max(radius, math::hypot(geometry::distance(part.room.room.space, centre.floor, p.floor), p.z - centre.z));
    }
    const std::vector<std::uint32_t> near = light::images_within(part.lighting, centre, radius);
    for (std::size_t i = chunk * kChunk; i < end; ++i) {
      if (lit[i].k > 2) continue;
      const PointToLight asked = point_to_light(part, lit[i].triangle, surface::inset_corner(lit[i].k), light::kVertexTolerance);
      if (asked.known) {
        part.at_vertex[i] = *asked.known;
        continue;
      }
      ++count;
      part.at_vertex[i] = light::irradiance(part.lighting, asked.point, near);
      part.blind_vertex[i] = part.at_vertex[i] == Color{} && light::is_enclosed(part.lighting, asked.point);
    }
    if (chunk % 16 == 0) report(progress, "baking", done.fetch_add(16 * kChunk), part.at_vertex.size(), "points");
  });
  return count;
}

}  // namespace orbc::bake
