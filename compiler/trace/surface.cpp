// The surface at the end of a path. Plain walls, floor and ceiling are evaluated by formula, not from panel triangles. Checkers are exact
// geometry (cells between geodesics of the axial chart; on walls between arc lengths and heights), so that no tessellation shows.
#include <cmath>

#include "compiler/geometry/chart.h"
#include "compiler/place/alpha_mask.h"
#include "compiler/trace/follow.h"

namespace orbc::trace {

using geometry::Ambient;
using geometry::Point;
using geometry::Space;
using place::PartKind;

namespace {

Direction unit(Space space, const Direction& d) { return (1 / std::sqrt(inner(space, d, d))) * d; }

/// The normal of a geodesic triangle at the point b, towards its counter-clockwise side: orthogonal to both ∂/∂b directions, which are
/// the tangents (E − ⟨E, X⟩X)/|S| with heights z, for the edges E of the triangle and S = Σ bᵢXᵢ = |S|·X.
Direction triangle_normal(Space space, const place::PlacedMesh& mesh, const mesh::Triangle& triangle, const double b[3], const Point& at) {
  const double k = geometry::curvature(space);
  const Point& p0 = mesh.floor[triangle[0]];
  const Point& p1 = mesh.floor[triangle[1]];
  const Point& p2 = mesh.floor[triangle[2]];
  const Ambient sum = b[0] * p0 + b[1] * p1 + b[2] * p2;
  const double size = space == Space::euclidean ? 1 : std::sqrt(std::fabs(sum.w * sum.w + k * (sum.x * sum.x + sum.y * sum.y)));
  // An orthonormal frame (e1, e2) of the floor at X, right-handed with z up.
  const geometry::Tangent e1 =
      geometry::normalised_tangent(space, at, std::fabs(at.x) <= std::fabs(at.y) ? Ambient{0, 1, 0} : Ambient{0, 0, 1});
  const Ambient left = {at.x * e1.y - at.y * e1.x, at.y * e1.w - at.w * e1.y, at.w * e1.x - at.x * e1.w};
  const Ambient e2 = {k * left.w, left.x, left.y};
  const auto edge = [&](const Point& to, double dz) {
    const Ambient e = to - p0;
    const auto component = [&](const Ambient& f) { return (k * f.w * e.w + f.x * e.x + f.y * e.y) / size; };
    return geometry::Vector3{component(e1), component(e2), dz};
  };
  const double z0 = mesh.z[triangle[0]];
  const auto n = cross(edge(p1, mesh.z[triangle[1]] - z0), edge(p2, mesh.z[triangle[2]] - z0));
  return {n.x * Ambient(e1) + n.y * e2, n.z};
}

void fill_triangle(const TraceScene& scene, const Hit& hit, SurfacePoint& point) {
  const Space space = scene.prism.space;
  const place::PlacedMesh& mesh = scene.interior->parts[hit.part];
  const mesh::Triangle& triangle = mesh.triangles[hit.triangle];
  point.kind = mesh.kind;
  point.part = hit.part;
  point.wall = mesh.wall;
  point.style = mesh.style.empty() ? -1 : mesh.style[hit.triangle];
  if (point.style >= 0) point.color = scene.interior->styles[point.style].color;
  const Direction normal = unit(space, triangle_normal(space, mesh, triangle, hit.b, point.at.floor));
  point.front_facing = inner(space, normal, point.incoming) <= 0;
  point.normal = point.front_facing ? normal : -normal;
  if (!mesh.color.empty()) point.color = point.color * place::interpolated_color(mesh, hit.triangle, hit.b);
  for (int i = 0; i < 3; ++i) {
    if (!mesh.uv.empty())
      for (int j = 0; j < 2; ++j) point.uv[j] += hit.b[i] * mesh.uv[triangle[i]][j];
    if (!mesh.pattern_position.empty()) point.pattern_position = point.pattern_position + hit.b[i] * mesh.pattern_position[triangle[i]];
  }
}

/// Sets the style of a wall, floor or ceiling, and the colour of the checker's cell at uv by the parity of the cell's numbers, as the
/// panels are cut. With a texture: uv in repeats, in the disk chart at true size in the centre, on walls (arc length, z), v downwards.
void fill_shell(const TraceScene& scene, const ShellStyle& panel, SurfacePoint& point) {
  point.part = panel.part;
  point.style = panel.style;
  if (panel.style < 0) return;
  const place::SurfaceStyle& look = scene.interior->styles[panel.style];
  point.color = look.color;
  if (look.material.pattern == scene::Pattern::texture) {
    auto at = std::complex<double>(point.uv[0], point.uv[1]);
    if (point.kind != PartKind::wall)
      at = (scene.prism.space == Space::euclidean ? 1.0 : 2.0) * geometry::disk_from_point(scene.prism.space, point.at.floor);
    point.uv[0] = at.real() / look.material.cell;
    point.uv[1] = -at.imag() / look.material.cell;
  }
  if (look.material.pattern != scene::Pattern::checker) return;
  const double cells = std::floor(point.uv[0] / look.material.cell) + std::floor(point.uv[1] / look.material.cell);
  point.second_color = std::fmod(cells, 2) != 0;
  point.color = point.second_color ? look.material.second : look.material.color;
}

}  // namespace

SurfacePoint surface_at(const TraceScene& scene, const Ray& ray, const Hit& hit) {
  const Space space = scene.prism.space;
  SurfacePoint point;
  point.at = position_at(space, ray, hit.t);
  point.incoming = direction_at(space, ray, hit.t);
  if (hit.kind == HitKind::triangle) {
    fill_triangle(scene, hit, point);
  } else if (hit.kind == HitKind::wall) {
    const room::Wall& wall = scene.prism.walls[hit.wall];
    point.kind = PartKind::wall;
    point.wall = hit.wall;
    point.normal = normal_of_wall(space, wall);
    point.uv[0] = arc_on_wall(space, wall, point.at.floor);
    point.uv[1] = point.at.z;
    fill_shell(scene, scene.walls[hit.wall], point);
  } else if (hit.kind == HitKind::floor || hit.kind == HitKind::ceiling) {
    const bool floor = hit.kind == HitKind::floor;
    point.kind = floor ? PartKind::floor : PartKind::ceiling;
    point.at.z = floor ? 0 : scene.prism.height;
    point.normal = {{0, 0, 0}, floor ? 1.0 : -1.0};
    const auto uv = geometry::axial_from_point(space, point.at.floor);
    point.uv[0] = uv.real();
    point.uv[1] = uv.imag();
    fill_shell(scene, floor ? scene.floor : scene.ceiling, point);
  }
  return point;
}

}  // namespace orbc::trace
