#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "compiler/base/result.h"
#include "compiler/place/polygon_mesh.h"
#include "compiler/place/interior.h"

namespace orbc::place {

struct PanelOptions {
  std::size_t max_cells = 200'000;   ///< most cells of one floor, ceiling or wall
  double texel_error = 0.25;         ///< largest error of a texture's position on a panel, in texels
  int texture_size = 1024;           ///< texels along one repeat, for `texel_error`
};

/// The materials of floor, ceiling and walls, as the author wrote them. A floor or ceiling that is a mirror has none.
struct Shell {
  std::optional<scene::Material> floor, ceiling;
  std::vector<scene::Material> walls;            ///< one per wall of the room
};

/// Builds floor, ceiling and the plain parts of the walls as geodesic triangles.
/// In:    mirrors clipped to their walls (`clipped_mirrors`). Their rectangles are cut out.
/// Makes: parts in the order floor, ceiling, wall 1, wall 2, …, without the empty ones. Checkers are cut along their cells: floor and
///        ceiling along squares of `cell` in axial coordinates, walls along (arc length, z). Style 0 is `color`, style 1 is `second`.
///        Textured panels have uv in repeats of `cell`, v downwards: floor and ceiling in the disk chart (true size at the centre), walls
///        in (arc length, z). They are not cut at whole numbers yet.
/// Exact: the shell is watertight. Panels that meet share every vertex of their common edge, bit by bit.
/// Diagnostics: place.too-many-cells, whose hint names a cell size that fits.
[[nodiscard]] Result<std::vector<PlacedMesh>> make_panels(const room::Room& room, double height, const Shell& shell,
                                                          const std::vector<PlacedMirror>& mirrors, const PanelOptions& options = {});

/// The floor as polygons at height 0, cut into cells of axial coordinates; uncut for cell = 0.
/// Makes:       polygons whose label is the parity of their cell. Edges on the room's boundary have the wall's index (from 0) as side.
/// Diagnostics: place.too-many-cells.
[[nodiscard]] Result<PolygonMesh> floor_polygons(const room::Room& room, double cell, std::size_t max_cells);

/// The arc length from the wall's start to X, in [0, length]. In: X on the wall.
[[nodiscard]] double arc_on_wall(const room::Room& room, int wall, const geometry::Point& x);

}  // namespace orbc::place
