#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "compiler/base/result.h"
#include "compiler/place/net.h"
#include "compiler/place/placed.h"

namespace orbc::place {

struct PanelOptions {
  std::size_t max_cells = 200'000;   ///< of one floor, ceiling or wall
  double texel_error = 0.25;         ///< largest error of a texture's place on a panel, in its texels
  int texture_size = 1024;           ///< texels along one repeat, for `texel_error`
};

/// What a room's shell is made of. Materials as the author wrote them; a surface that is a mirror has none.
struct Shell {
  std::optional<scene::Material> floor, ceiling;
  std::vector<scene::Material> walls;            ///< one for each wall of the room
};

/// Builds floor, ceiling and the plain parts of the walls as geodesic triangles.
/// In:    mirrors clipped to their walls (`clipped_mirrors`); their rectangles are cut out.
/// Makes: parts in the order floor, ceiling, wall 1, wall 2, …, without the empty ones. Chequered surfaces are cut along their cells: floor
///        and ceiling along squares of `cell` in axial coordinates, walls along (arc length, z); look 0 is `color`, look 1 is `second`.
///        Textured ones carry uv in repeats of `cell`: floor and ceiling in the disk chart (true size at the centre), walls in (arc length,
///        z), v downwards; not yet cut at whole numbers.
///        The shell is watertight: panels that meet share every vertex of their common edge, bit by bit.
/// Diagnostics: place.too-many-cells; the hint names a cell size that fits.
[[nodiscard]] Result<std::vector<PlacedMesh>> make_panels(const room::Room& room, double height, const Shell& shell,
                                                          const std::vector<PlacedMirror>& mirrors, const PanelOptions& options = {});

/// The floor as one net at height 0, cut into cells of axial coordinates (uncut for cell = 0); a piece's tag is the parity of its cell.
/// The edges on the border have the wall's number (from 0) as side. Diagnostics: place.too-many-cells.
[[nodiscard]] Result<Net> floor_net(const room::Room& room, double cell, std::size_t max_cells);

/// The arc length from the wall's start at which X lies, X on the wall; in [0, length].
[[nodiscard]] double arc_on_wall(const room::Room& room, int wall, const geometry::Point& x);

}  // namespace orbc::place
