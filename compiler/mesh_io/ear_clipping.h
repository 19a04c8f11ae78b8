#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace orbc::mesh_io {

using PlanePoint = std::array<double, 2>;

/// Cuts a long polygon in the plane into triangles by clipping ears.
/// In:     at least three corners, counter-clockwise. Corners may coincide, as where a bridge joins a hole to the border.
/// Makes:  n − 2 triangles with the polygon's orientation, as indices into `ring`. A polygon that crosses itself gets some n − 2 triangles.
/// Time:   up to 200 steps a corner for simple polygons (tested). Once `steps` are spent, the rest becomes a fan. Reduces `steps`.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> clip_ears(const std::vector<PlanePoint>& ring, std::int64_t& steps);

}  // namespace orbc::mesh_io
