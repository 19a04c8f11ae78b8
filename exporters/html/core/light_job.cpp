#include "exporters/html/core/light_job.h"

#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"
#include "compiler/geometry/chart.h"
#include "compiler/surface/normals.h"

namespace orbc::html {
namespace {

using geometry::Point;

constexpr int kFloorSide = 96;  // points along the floor: a shadow's border is a fortieth of a room wide at best
constexpr int kWallColumns = 32, kWallRows = 16;

surface::ShadingPoint shell_point(const geometry::Position& at, const trace::Direction& normal, int wall) {
  surface::ShadingPoint point;
  point.at = point.ray_origin = at;
  point.normal = point.geometric_normal = normal;
  point.wall = wall;
  point.on_triangle = false;
  return point;
}

// The grid reaches half a cell beyond the room, so that interpolation between its points covers all of it.
LightGrid add_horizontal_grid(LightJob& job, const place::Interior& interior, bool ceiling) {
  const room::Room& room = interior.polygon;
  LightGrid grid{kFloorSide, kFloorSide, 0, job.points.size()};
  for (const Point& p : room.outline) grid.reach = std::fmax(grid.reach, math::abs(geometry::disk_from_point(room.space, p)));
  if (room.outline.size() < 3) grid.reach = std::fmax(grid.reach, 1.0);
  const double cell = 2 * grid.reach / (kFloorSide - 1);
  for (int j = 0; j < grid.rows; ++j)
    for (int i = 0; i < grid.columns; ++i) {
      const std::complex<double> z(-grid.reach + i * cell, -grid.reach + j * cell);
      const bool exists = room.space != geometry::Space::hyperbolic || math::abs(z) < 0.999;
      const Point at = exists ? geometry::point_from_disk(room.space, z) : Point{};
      bool seen = exists;
      for (const room::Wall& wall : room.walls) seen = seen && geometry::value_at(wall.line, at) > 0;
      job.points.push_back(shell_point({at, ceiling ? interior.height : 0}, {{0, 0, 0}, ceiling ? -1.0 : 1.0}, -1));
      job.is_seen.push_back(seen);
    }
  return grid;
}

LightGrid add_wall_grid(LightJob& job, const place::Interior& interior, int number) {
  const room::Wall& wall = interior.polygon.walls[static_cast<std::size_t>(number)];
  LightGrid grid{kWallColumns, kWallRows, 0, job.points.size()};
  const double k = geometry::curvature(interior.polygon.space);
  const bool mirror_only = [&] {
    for (const place::PlacedMesh& part : interior.parts)
      if (part.kind == place::PartKind::wall && part.wall == number) return false;
    return true;
  }();
  for (int j = 0; j < grid.rows; ++j)
    for (int i = 0; i < grid.columns; ++i) {
      const double s = wall.length * (i + 0.5) / grid.columns, z = interior.height * (j + 0.5) / grid.rows;
      const Point at = geometry::point_along(interior.polygon.space, wall.start, wall.along, s);
      job.points.push_back(shell_point({at, z}, {{k * wall.line.w, wall.line.x, wall.line.y}, 0}, number));
      job.is_seen.push_back(!mirror_only);
    }
  return grid;
}

}  // namespace

LightJob light_job(light::LightingContext lighting, const place::Interior& interior, const DrawnMeshes& drawn) {
  LightJob job;
  job.lighting = std::move(lighting);
  if (!job.lighting.lit) return job;
  for (const DrawnVertex& v : drawn.vertices) {
    // A vertex itself may touch another surface: light is computed a little inside of its triangle.
    std::array<double, 3> b = v.b;
    for (double& x : b) x = (1 - 1.5 * surface::kInset) * x + 0.5 * surface::kInset;
    job.points.push_back(surface::shading_point(interior, interior.parts[v.part], job.lighting.normals[v.part], v.triangle, b));
    job.is_seen.push_back(true);
  }
  job.floor = add_horizontal_grid(job, interior, false);
  job.ceiling = add_horizontal_grid(job, interior, true);
  for (std::size_t i = 0; i < interior.polygon.walls.size(); ++i) job.walls.push_back(add_wall_grid(job, interior, static_cast<int>(i)));
  return job;
}

scene::Color light_at(const LightJob& job, std::size_t point) {
  if (!job.is_seen[point]) return {-1, -1, -1};
  return job.lighting.ambient + (1 / std::numbers::pi) * light::irradiance(job.lighting, job.points[point]);
}

}  // namespace orbc::html
