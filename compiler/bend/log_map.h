#pragma once
#include <cstddef>
#include <vector>

#include "compiler/geometry/isometry.h"
#include "compiler/geometry/point.h"

namespace orbc::bend {

/// The log map of the eye after an isometry: room coordinates of a copy → eye coordinates. Sheets: cover/copy.h.
struct LogMap {
  geometry::Space space = geometry::Space::euclidean;
  geometry::Matrix3 eye_from_copy{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  int sheet = 0;
};

/// Points of the room as one array per coordinate. (w, x, y) is on the surface: w² + κ(x² + y²) = 1.
struct PointColumns {
  std::vector<double> w, x, y;
  std::vector<float> z;
};

/// The image of one point in eye coordinates.
/// In:      p on the surface. On S² a point exactly at the eye's foot (sheet ≥ 1) or exactly opposite has no image; it gets direction +x.
/// Formula: ((x, y)·r/ρ, z) with (w, x, y) = eye_from_copy · p, ρ = |(x, y)|, and r the distance of the point on its sheet (design §2).
/// Error:   a few ulp beyond the rounding of the matrix product.
[[nodiscard]] geometry::Vector3 bent_position(const LogMap& map, const geometry::Ambient& p, double z);

/// The images of points[first … first + count), three floats each, written to `out`: the matrix product in double, the arc length in float,
/// by the widest vector instructions of the machine.
/// Exact: the same bits on every machine.
/// Error: ≤ 4 ulp of the largest coordinate (measured: tests/unit/bend).
void bend_points(const LogMap& map, const PointColumns& points, std::size_t first, std::size_t count, float* out);

/// The same without vector instructions: all in double, rounded once.
void bend_points_scalar(const LogMap& map, const PointColumns& points, std::size_t first, std::size_t count, float* out);

}  // namespace orbc::bend
