#pragma once
#include <complex>

#include "compiler/geometry/point.h"

namespace orbc::geometry {

/// Disk chart (conformal): (x, y)/(1 + w) on S² (stereographic) and H² (Poincaré), (x, y) on E². Used for positions, textures and pictures.
[[nodiscard]] std::complex<double> disk_from_point(Space space, const Point& p);
/// In: any z on S² and E²; |z| < 1 on H².
[[nodiscard]] Point point_from_disk(Space space, std::complex<double> z);

/// Gnomonic chart (Klein): (x, y)/w, where geodesics are straight. On S² only for w > 0.
[[nodiscard]] std::complex<double> gnomonic_from_point(const Point& p);

/// Log map at the origin: maps the point at distance r in direction φ to r·e^{iφ}. Distances from the origin are true.
[[nodiscard]] std::complex<double> log_from_point(Space space, const Point& p);
[[nodiscard]] Point point_from_log(Space space, std::complex<double> z);

/// Axial coordinates: arc lengths (u, v) at which the perpendiculars from P meet the x- and the y-axis. Their grid lines are geodesics,
/// so the cells of a checkered floor are exactly geodesic. u = atanκ(x/w), v = atanκ(y/w). On S² only for w ≥ 0.
[[nodiscard]] std::complex<double> axial_from_point(Space space, const Point& p);
/// In H² the two perpendiculars need not meet: tanh²u + tanh²v < 1 is required.
[[nodiscard]] Point point_from_axial(Space space, std::complex<double> uv);

}  // namespace orbc::geometry
