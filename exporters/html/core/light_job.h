#pragma once
#include <memory>
#include <vector>

#include "compiler/light/lighting.h"
#include "exporters/html/core/drawn_mesh.h"

namespace orbc::html {

/// A grid of points on a part of the room's shell, for which light is computed. Row by row: `columns` points in a row.
/// Floor and ceiling: the disk chart from −reach to reach in x, then y. Walls: arc length from 0 to the wall's length, then height.
struct LightGrid {
  int columns = 0, rows = 0;
  double reach = 0;       ///< floor and ceiling
  std::size_t first = 0;  ///< index of its first point among those of the job
};

/// The light of a room as the page shows it: at the vertices of its meshes, and on grids over floor, ceiling and walls.
struct LightJob {
  light::LightingContext lighting;
  std::vector<surface::ShadingPoint> points;
  std::vector<bool> is_seen;  ///< points of the floor's grid outside the room are not computed
  LightGrid floor, ceiling;
  std::vector<LightGrid> walls;
};

/// The points of a room that are lit. In: the meshes drawn of it.
[[nodiscard]] LightJob light_job(light::LightingContext lighting, const place::Interior& interior, const DrawnMeshes& drawn);

/// The irradiance divided by π at a point of the job, ambient light included; direct light alone, also for `integrator: path`.
[[nodiscard]] scene::Color light_at(const LightJob& job, std::size_t point);

}  // namespace orbc::html
