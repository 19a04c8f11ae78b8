#pragma once
#include <array>
#include <cstdint>

#include "compiler/mesh/mesh.h"

namespace orbc::mesh {

// Closed triangle meshes of simple bodies, z up, centred at the origin, counter-clockwise seen from outside, with uv in [0,1]² (v from
// top). Vertices are doubled where uv jumps, with bitwise the same position, so the surface stays closed. In: lengths > 0.

/// Latitude and longitude: 2·around·(rings−1) triangles, around ≥ 3, rings ≥ 2 (bands from pole to pole).
[[nodiscard]] Mesh make_sphere(double radius, int around = 64, int rings = 32);
/// A body with flat caps: 2·around·bands + 2·around·(2·cap_rings − 1) triangles; `bands` along the height, `cap_rings` from rim to axis.
[[nodiscard]] Mesh make_cylinder(double radius, double height, int around = 64, int bands = 8, int cap_rings = 4);
/// A box with `cells` squares along each edge direction: 4·(ab + bc + ca) triangles.
[[nodiscard]] Mesh make_box(const std::array<double, 3>& size, const std::array<int, 3>& cells = {8, 8, 8});
/// A box of square section along +x: from x = −length/2 to length/2, `cells` along, `across` across each side.
[[nodiscard]] Mesh make_beam(double length, double width, int cells = 32, int across = 1);
/// A ring around the z axis: 2·around·across triangles.
[[nodiscard]] Mesh make_torus(double radius, double tube, int around = 96, int across = 32);
/// The (p, q) torus knot, p and q coprime: p times around the z axis, q times through the hole; its middle line lies on the torus of radii
/// `radius` and `radius`/2.5. 2·along·across triangles. The tube is swept by frames that do not twist.
[[nodiscard]] Mesh make_torus_knot(int p, int q, double radius, double tube, int along = 400, int across = 24);

}  // namespace orbc::mesh
