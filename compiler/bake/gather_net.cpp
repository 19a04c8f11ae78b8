#include "compiler/bake/gather_net.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "compiler/light/connection.h"
#include "compiler/surface/tangent_frame.h"

namespace orbc::bake {
namespace {

constexpr double kMaxVertexInset = 0.25;  // of the spacing of gather points, and of the distance to the mean of the neighbouring vertices
constexpr int kMaxPointsPerSide = 129;    // of a patch

/// A part whose gather points are made.
struct NetPart {
  const LitPatches& surfaces;
  const PatchLocator& locator;
  const place::PlacedMesh& mesh;
  const surface::PartNormals& normals;
  double density = 0;
  bool is_lod = false;
};

/// The mean of the vertices around a vertex.
struct NeighbourMean {
  geometry::Ambient floor{0, 0, 0};
  double z = 0;
  int count = 0;
};

/// Per vertex of the normals; without neighbours on floor, ceiling and walls.
std::vector<NeighbourMean> neighbour_means(const NetPart& part) {
  std::vector<NeighbourMean> means(part.normals.vertices.size());
  if (part.mesh.kind != place::PartKind::object && part.mesh.kind != place::PartKind::frame) return means;
  for (std::size_t t = 0; t < part.mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t other = 0; other < 3; ++other) {
        if (other == k) continue;
        const std::uint32_t v = part.mesh.triangles[t][other];
        NeighbourMean& mean = means[part.normals.corners[t][k]];
        mean.floor = mean.floor + part.mesh.floor[v];
        mean.z += part.mesh.z[v];
        ++mean.count;
      }
  for (NeighbourMean& mean : means) {
    if (mean.count == 0) continue;
    const double share = 1.0 / mean.count;
    mean.floor = share * mean.floor;
    mean.z = share * mean.z;
  }
  return means;
}

struct InsetVertex {
  surface::ShadingPoint point;
  double distance = 0;  ///< by which it was moved
};

/// Moves a vertex along the tangent plane towards the mean of its neighbours. Shadows begin where an object touches the floor, so a vertex
/// there would gather almost nothing; a little further inside of the surface it gathers what is typical for the surface. In the middle of
/// a smooth surface a vertex stays where it is.
InsetVertex inset_vertex(const NetPart& part, surface::ShadingPoint point, const NeighbourMean& mean) {
  if (mean.count == 0) return {point, 0};
  const geometry::Space space = part.surfaces.interior.polygon.space;
  const surface::TangentFrame frame = surface::tangent_frame(space, point.at.floor);
  const geometry::Vector3 n = surface::to_local(space, frame, point.normal);
  const geometry::Vector3 to_mean = surface::to_local(space, frame, {mean.floor - point.at.floor, mean.z - point.at.z});
  const geometry::Vector3 along = to_mean - dot(to_mean, n) * n;
  const double length = geometry::length(along), step = std::min(kMaxVertexInset * length, kMaxVertexInset / part.density);
  if (length > 1e-9) point.at = point.ray_origin = surface::exponential(space, point.at, frame, (step / length) * along);
  return {point, step};
}

/// In: how far from the surface the point of a level of detail may lie.
GatherPoint make_gather_point(const NetPart& part, const surface::ShadingPoint& point, double reach, std::uint16_t style) {
  if (!part.is_lod) return {point, {}};
  const light::SurfaceProjection projected = light::project_to_surface(part.surfaces.lighting, point, reach);
  return {projected.point, part.locator.find_for_lod(projected.hit, style)};
}

std::vector<GatherPoint> vertex_points(const NetPart& part) {
  const std::vector<NeighbourMean> means = neighbour_means(part);
  std::vector<PatchCorner> corners(part.normals.vertices.size());
  for (std::size_t t = 0; t < part.mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) corners[part.normals.corners[t][k]] = {t, k};
  std::vector<GatherPoint> points;
  for (std::size_t v = 0; v < corners.size(); ++v) {
    const auto [triangle, k] = corners[v];
    const std::uint16_t style = part.mesh.style[triangle];
    const InsetVertex inset =
        inset_vertex(part, surface::shading_point(part.surfaces.interior, part.mesh, part.normals.vertices[v]), means[v]);
    points.push_back(make_gather_point(part, inset.point, std::max(light::kVertexTolerance, inset.distance), style));
    if (!part.is_lod) continue;
    // A vertex of a level of detail that is a vertex of the part, too, has the light of that vertex.
    const surface::ShadingPoint corner =
        surface::shading_point(part.surfaces.interior, part.mesh, part.normals, triangle, surface::inset_corner(k));
    const light::SurfaceProjection projected = light::project_to_surface(part.surfaces.lighting, corner, light::kVertexTolerance);
    if (const PatchUv on = part.locator.find_for_lod(projected.hit, style); on.patch >= 0) points.back().base = on;
  }
  return points;
}

int points_per_side(double length, double density) {
  return std::clamp(static_cast<int>(std::ceil(length * density - 1e-9)), 1, kMaxPointsPerSide - 1) + 1;
}

/// The points of a patch. Those inside of it are new ones, and get numbers from `next` on.
struct NewPatchPoints {
  PatchPoints grid;
  std::vector<GatherPoint> inside;
};
NewPatchPoints patch_points(const NetPart& part, const TexelPatch& patch, std::size_t first_vertex, std::size_t next) {
  NewPatchPoints made;
  PatchPoints& grid = made.grid;
  grid.width = points_per_side(patch.length_u, part.density);
  grid.height = points_per_side(patch.length_v, part.density);
  if (patch.second < 0) grid.width = grid.height = std::max(grid.width, grid.height);
  for (int j = 0; j < grid.height; ++j)
    for (int i = 0; i < grid.width; ++i) {
      const bool far_u = i == grid.width - 1, far_v = j == grid.height - 1;
      if (!on_patch(patch, i, j, grid.width, grid.height)) {
        grid.point.push_back(-1);
      } else if ((i == 0 || far_u) && (j == 0 || far_v)) {
        const PatchCorner corner = corner_of(patch, far_u, far_v);
        grid.point.push_back(static_cast<std::int32_t>(first_vertex + part.normals.corners[corner.triangle][corner.k]));
      } else {
        const double u = static_cast<double>(i) / (grid.width - 1), v = static_cast<double>(j) / (grid.height - 1);
        const BarycentricPoint at = inset_point(patch, u, v, surface::kInset);
        grid.point.push_back(static_cast<std::int32_t>(next + made.inside.size()));
        made.inside.push_back(make_gather_point(part,
                                                surface::shading_point(part.surfaces.interior, part.mesh, part.normals, at.triangle, at.b),
                                                std::max(patch.length_u, patch.length_v) / 2, part.mesh.style[at.triangle]));
      }
    }
  return made;
}

}  // namespace

GatherNet make_gather_net(const LitPatches& surfaces, const PatchLocator& locator, double density) {
  GatherNet net;
  for (std::size_t p = 0; p < surfaces.interior.parts.size(); ++p) {
    const bool is_lod = p >= surfaces.lighting.normals.size();
    const NetPart part{surfaces, locator, surfaces.interior.parts[p], *surfaces.normals[p], density, is_lod};
    const std::size_t first_vertex = net.points.size();
    for (GatherPoint& point : vertex_points(part)) net.points.push_back(point);
    for (const TexelPatch& patch : surfaces.patches[p]) {
      NewPatchPoints made = patch_points(part, patch, first_vertex, net.points.size());
      net.points.insert(net.points.end(), made.inside.begin(), made.inside.end());
      net.patches.push_back(std::move(made.grid));
    }
  }
  return net;
}

}  // namespace orbc::bake
