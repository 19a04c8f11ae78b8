// Lunes and rectangles, which need no inscribed circle.
#include "compiler/room/polygon.h"

namespace orbc::room {

using geometry::Space;

std::vector<CornerAngle> corner_angles(const std::vector<Rational>& orders) {
  std::vector<CornerAngle> angles;
  for (std::size_t i = 0; i < orders.size(); ++i) {
    std::size_t same = 0;
    while (same < i && orders[same] != orders[i]) ++same;
    if (same < i) {
      angles.push_back(angles[same]);
      continue;
    }
    const Real angle = real_pi() * real_of(denominator(orders[i])) / real_of(numerator(orders[i]));
    if (orders[i] == 2) {
      const Real half = sqrt(Real(0.5));
      angles.push_back({angle, 1, 0, half, half});
      continue;
    }
    const Real sin_half = sin(angle / 2), cos_half = cos(angle / 2);
    angles.push_back({angle, 2 * sin_half * cos_half, (cos_half - sin_half) * (cos_half + sin_half), sin_half, cos_half});
  }
  return angles;
}

Polygon lune(const CornerAngle& angle) {
  // Wall 1 runs from +x over the side of +y to −x; its nearest point is half the angle away from the centre.
  const Real &c = angle.cos_half, &s = angle.sin_half;
  return {Space::spherical, {{s, 0, -c}, {s, 0, c}}, {{0, 1, 0}, {0, -1, 0}}, angle.angle / 2};
}

Polygon rectangle(const Real& side1, const Real& side2) {
  // Wall 1 is seen from the centre under the angle 2 atan(side 1/side 2); n is the unit vector towards its middle.
  const Real a = side1 / 2, b = side2 / 2, r2 = a * a + b * b, r = sqrt(r2);
  const Real nx = b / r, ny = a / r, cx = (b * b - a * a) / r, cy = 2 * a * b / r;
  return {Space::euclidean,
          {{b, -nx, -ny}, {a, ny, -nx}, {b, nx, ny}, {a, -ny, nx}},
          {{1, r, 0}, {1, cx, cy}, {1, -r, 0}, {1, -cx, -cy}},
          side1 == side2 ? b : Real(0)};
}

}  // namespace orbc::room
