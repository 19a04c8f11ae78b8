#pragma once
#include <string>
#include <vector>

#include "exporters/svg/page.h"

namespace orbc::svg {

/// The whole geodesic through two different points, which are marked on it. On the sphere they are not opposite.
struct Geodesic {
  geometry::Point from, to;
};

/// Points of a geodesic in equal steps, from `−beyond` before `from` to `beyond` after `to`; on the sphere once around.
[[nodiscard]] std::vector<geometry::Point> points_on(geometry::Space space, const Geodesic& geodesic, double beyond, double step);

/// Geodesics as lines with their two points as dots, in any chart. What the chart does not show of them is left out.
[[nodiscard]] std::string geodesic_lines(const Page& page, const std::vector<Geodesic>& geodesics);

}  // namespace orbc::svg
