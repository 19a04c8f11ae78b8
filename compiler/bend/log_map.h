#pragma once
#include <cstddef>
#include <vector>

#include "compiler/geometry/isometry.h"
#include "compiler/geometry/point.h"

namespace orbc::bend {

/// The log map of the eye after an isometry: copy coordinates → eye coordinates.
/// `sheet` counts the half turns around S²: a point at distance r is seen on sheet 0 at r, on sheet 1 at 2π − r in the opposite direction,
/// on sheet 2 at 2π + r, …; always 0 elsewhere.
struct LogMap {
  geometry::Space space = geometry::Space::euclidean;
  geometry::Matrix3 eye_from_copy{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  int sheet = 0;
};

/// Points of the room, coordinate by coordinate. Floor points are on the surface: w² + κ(x² + y²) = 1.
struct PointColumns {
  std::vector<double> w, x, y;
  std::vector<float> z;
};

/// Where the eye sees one point: ((x, y)·r/ρ, z) with (w, x, y) = eye_from_copy · p, ρ = |(x, y)|, r its arc length. Source: design §2.
/// In:    p on the surface. On S² a point exactly below the eye (sheet ≥ 1) or exactly opposite has no image; it is put in direction +x.
/// Error: a few ulp beyond the rounding of the matrix product.
[[nodiscard]] geometry::Vector3 bent_position(const LogMap& map, const geometry::Ambient& p, double z);

/// The same for points[first … first + count), three floats each: the matrix product in double, the arc length in float, by the widest
/// vector instructions of the machine. One machine gives the same bytes always; machines of different width may differ by 4 ulp.
/// Error: ≤ 4 ulp of the largest coordinate. Measured: tests/unit/bend.
void bend_points(const LogMap& map, const PointColumns& points, std::size_t first, std::size_t count, float* out);

/// Scalar twin of `bend_points`: all in double, rounded once.
void bend_points_scalar(const LogMap& map, const PointColumns& points, std::size_t first, std::size_t count, float* out);

}  // namespace orbc::bend
