#include "compiler/bake/bake_part.h"

#include <algorithm>
#include <atomic>

#include "compiler/base/elementary.h"
#include "compiler/light/connection.h"

namespace orbc::bake {
namespace {

using scene::Color;

constexpr std::size_t kVerticesPerChunk = 32;

/// Corner k of a triangle at which a vertex is lit; k = 3: it is not lit.
struct LitCorner {
  std::size_t triangle = 0, k = 3;
};

/// Per vertex, the first corner of a surface that is not emissive.
std::vector<LitCorner> lit_corners(const BakePart& part) {
  std::vector<LitCorner> corners(part.normals.vertices.size());
  for (std::size_t t = 0; t < part.mesh.triangles.size(); ++t) {
    if (part.interior.styles[part.mesh.style[t]].material.kind == scene::MaterialKind::emissive) continue;
    for (std::size_t k = 0; k < 3; ++k)
      if (LitCorner& corner = corners[part.normals.corners[t][k]]; corner.k == 3) corner = {t, k};
  }
  return corners;
}

/// The lamp images that may reach any of the vertices from `first` to `end`.
std::vector<std::uint32_t> images_near_vertices(const BakePart& part, std::size_t first, std::size_t end) {
  const auto position = [&](std::size_t i) {
    const std::uint32_t v = part.normals.vertices[i].vertex;
    return geometry::Position{part.mesh.floor[v], part.mesh.z[v]};
  };
  const geometry::Position centre = position(first);
  double radius = 0;
  for (std::size_t i = first; i < end; ++i) {
    const geometry::Position p = position(i);
    radius = std::max(radius, math::hypot(geometry::distance(part.interior.polygon.space, centre.floor, p.floor), p.z - centre.z));
  }
  return light::images_within(part.lighting, centre, radius);
}

}  // namespace

BakePoint make_bake_point(const BakePart& part, std::size_t triangle, const std::array<double, 3>& b, double reach) {
  BakePoint made{surface::shading_point(part.interior, part.mesh, part.normals, triangle, b), {}};
  if (!part.base) return made;
  const light::SurfaceProjection projected = light::project_to_surface(part.lighting, made.point, reach);
  made.point = projected.point;
  if (const PatchUv on = part.base->locator.find_for_lod(projected.hit, part.mesh.style[triangle]); on.patch >= 0)
    made.known_irradiance = interpolate(part.base->direct[static_cast<std::size_t>(on.patch)], on.u, on.v);
  return made;
}

VertexLight light_vertices(const BakePart& part, const Executor& executor, const Progress& progress) {
  const std::vector<LitCorner> corners = lit_corners(part);
  VertexLight made{std::vector<Color>(corners.size()), std::vector<std::uint8_t>(corners.size(), 0), 0};
  std::atomic<std::uint64_t> done{0}, lit_points{0};
  executor((corners.size() + kVerticesPerChunk - 1) / kVerticesPerChunk, [&](std::size_t chunk) {
    const std::size_t first = chunk * kVerticesPerChunk, end = std::min(first + kVerticesPerChunk, corners.size());
    const std::vector<std::uint32_t> images = images_near_vertices(part, first, end);
    for (std::size_t i = first; i < end; ++i) {
      if (corners[i].k == 3) continue;
      const BakePoint point = make_bake_point(part, corners[i].triangle, surface::inset_corner(corners[i].k), light::kVertexTolerance);
      if (point.known_irradiance) {
        made.irradiance[i] = *point.known_irradiance;
        continue;
      }
      ++lit_points;
      made.irradiance[i] = light::irradiance(part.lighting, point.point, images);
      made.enclosed[i] = made.irradiance[i] == Color{} && light::is_enclosed(part.lighting, point.point);
    }
    if (chunk % 16 == 0) report(progress, "baking", done.fetch_add(16 * kVerticesPerChunk), corners.size(), "points");
  });
  made.lit_points = lit_points;
  return made;
}

}  // namespace orbc::bake
