#include "exporters/svg/geodesic.h"

#include <cmath>
#include <numbers>

#include "compiler/base/elementary.h"
#include "exporters/svg/labels.h"
#include "exporters/svg/palette.h"

namespace orbc::svg {
namespace {

using geometry::Point;
using geometry::Space;

constexpr double kHyperbolicEnd = 9;  // curvature radii: 1.2e-4 of the disk's radius from its rim

/// How far a geodesic of the plane may have to be drawn to leave the page.
double flat_end(const Page& page) { return 2 * (page.width + page.height) / page.scale; }

/// Whether the chart shows a point in finite size.
bool is_shown(const Page& page, const Point& p) {
  if (page.space != Space::spherical) return true;
  return page.straight ? p.w > 0.05 : p.w > -0.95;
}

}  // namespace

std::vector<Point> points_on(Space space, const Geodesic& geodesic, double beyond, double step) {
  const geometry::Tangent along = geometry::direction_to(space, geodesic.from, geodesic.to);
  const double begin = space == Space::spherical ? 0 : -beyond;
  const double end = space == Space::spherical ? 2 * std::numbers::pi : geometry::distance(space, geodesic.from, geodesic.to) + beyond;
  const int pieces = static_cast<int>(std::ceil((end - begin) / step));
  std::vector<Point> points;
  for (int i = 0; i <= pieces; ++i)
    points.push_back(geometry::point_along(space, geodesic.from, along, begin + (end - begin) * i / pieces));
  return points;
}

std::string geodesic_lines(const Page& page, const std::vector<Geodesic>& geodesics) {
  std::string lines, dots;
  for (const Geodesic& geodesic : geodesics) {
    const bool is_flat = page.space == Space::euclidean;
    const double beyond = is_flat ? flat_end(page) : kHyperbolicEnd;
    const std::vector<Point> points = points_on(page.space, geodesic, beyond, is_flat ? beyond : 0.5);
    const geometry::Line line = geometry::line_through(page.space, geodesic.from, geodesic.to);
    std::string d;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Point middle = geometry::midpoint(page.space, points[i], points[i + 1]);
      if (is_shown(page, points[i]) && is_shown(page, points[i + 1])) d += open_path(page, {points[i], middle, points[i + 1], line});
    }
    lines += "<path d=\"" + d + "\"/>\n";
    for (const Point& p : {geodesic.from, geodesic.to}) {
      if (!is_shown(page, p)) continue;
      const std::complex<double> at = on_page(page, p);
      dots += "<circle" + attribute("cx", at.real()) + attribute("cy", at.imag()) + attribute("r", 7 * page.unit) + "/>\n";
    }
  }
  if (lines.empty()) return lines;
  const std::string ink = std::string(" stroke=\"") + kInk + "\"";
  return "<g fill=\"none\" stroke=\"" + std::string(kPaper) + "\"" + attribute("stroke-width", 7 * page.unit) + ">\n" + lines +
         "</g>\n<g fill=\"none\"" + ink + attribute("stroke-width", 3.4 * page.unit) + ">\n" + lines + "</g>\n<g fill=\"" + kPaper + "\"" +
         ink + attribute("stroke-width", 2.4 * page.unit) + ">\n" + dots + "</g>\n";
}

}  // namespace orbc::svg
