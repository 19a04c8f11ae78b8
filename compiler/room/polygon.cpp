// What all hyperbolic constructions share: corners from lines, and the move to the centre.
#include "compiler/room/polygon.h"

namespace orbc::room {
namespace {

using geometry::Space;

// A point with equal distance sinh s = `value` from all walls: Y with n·Y = 1 for three of them, then checked against the rest.
std::optional<RealVector> incentre(const Polygon& polygon, Real& inradius) {
  const std::vector<RealVector>& n = polygon.lines;
  const std::size_t count = n.size();
  const RealVector &a = n[0], &b = n[count / 3], &c = n[2 * count / 3];
  const Real det = value_at(a, cross(b, c));
  if (det == 0) return std::nullopt;
  const RealVector y = (1 / det) * (cross(b, c) + cross(c, a) + cross(a, b));
  const Real norm2 = -inner(-1, y, y);
  if (!(norm2 > 0) || !(y.w > 0)) return std::nullopt;
  for (const RealVector& line : n)
    if (abs(value_at(line, y) - 1) > 1e-12) return std::nullopt;
  inradius = asinh(1 / sqrt(norm2));
  return (1 / sqrt(norm2)) * y;
}

}  // namespace

std::optional<Polygon> closed_polygon(std::vector<RealVector> lines) {
  Polygon polygon{Space::hyperbolic, std::move(lines), {}, 0};
  const std::vector<RealVector>& n = polygon.lines;
  const std::size_t count = n.size();
  for (std::size_t i = 0; i < count; ++i) {
    // Walking counter-clockwise, the cross product of one wall's line and the next one's is the corner, on the upper sheet.
    const RealVector v = cross(n[(i + count - 1) % count], n[i]);
    const Real norm2 = -inner(-1, v, v);
    if (!(norm2 > 0) || !(v.w > 0)) return std::nullopt;
    polygon.corners.push_back((1 / sqrt(norm2)) * v);
  }
  for (std::size_t i = 0; i < count; ++i)
    if (!(inner(-1, cross(polygon.corners[i], polygon.corners[(i + 1) % count]), n[i]) > 0)) return std::nullopt;
  return polygon;
}

Polygon centred(const Polygon& polygon) {
  Polygon result{polygon.space, {}, {}, 0};
  RealVector centre{0, 0, 0};
  if (const auto middle = incentre(polygon, result.inradius)) {
    centre = *middle;
  } else {
    for (const RealVector& corner : polygon.corners) centre = centre + corner;
    centre = (1 / sqrt(-inner(-1, centre, centre))) * centre;
  }
  const RealVector& first = polygon.corners.front();
  RealVector x = first + inner(-1, first, centre) * centre;
  x = (1 / sqrt(inner(-1, x, x))) * x;
  const RealVector y = dual(-1, cross(centre, x));
  for (const RealVector& p : polygon.corners) result.corners.push_back({-inner(-1, centre, p), inner(-1, x, p), inner(-1, y, p)});
  for (const RealVector& n : polygon.lines) result.lines.push_back({value_at(n, centre), value_at(n, x), value_at(n, y)});
  result.corners.front().y = 0;
  return result;
}

Real side_length(const Polygon& polygon, std::size_t wall) {
  const RealVector &p = polygon.corners[wall], &q = polygon.corners[(wall + 1) % polygon.corners.size()], d = q - p;
  if (polygon.space == Space::euclidean) return sqrt(d.x * d.x + d.y * d.y);
  const Real chord2 = inner(geometry::curvature(polygon.space), d, d);
  return polygon.space == Space::spherical ? 2 * atan2(sqrt(chord2), sqrt(abs(4 - chord2))) : 2 * asinh(sqrt(chord2) / 2);
}

}  // namespace orbc::room
