// Formulas: design §2; sheets of S²: cover/copy.h. Everything is computed in double here; log_map_simd.cpp is the fast version.
#include "compiler/bend/log_map.h"

#include <cmath>
#include <numbers>

namespace orbc::bend {

using geometry::Ambient;
using geometry::Space;

geometry::Vector3 bent_position(const LogMap& map, const Ambient& p, double z) {
  const Ambient q = map.eye_from_copy * p;
  if (map.space == Space::euclidean) return {q.x, q.y, z};
  const double rho = std::sqrt(q.x * q.x + q.y * q.y);
  const double r = geometry::arc_k(map.space, q.w, rho);
  if (map.sheet == 0) {
    if (rho < 1e-150) return {q.w > 0 ? q.x : r, q.y, z};
    return {q.x * (r / rho), q.y * (r / rho), z};
  }
  const bool far_side = map.sheet % 2 == 1;
  const double path = far_side ? r - (map.sheet + 1) * std::numbers::pi : map.sheet * std::numbers::pi + r;
  if (rho < 1e-150) return {path, 0, z};
  return {q.x * (path / rho), q.y * (path / rho), z};
}

void bend_points_scalar(const LogMap& map, const PointColumns& points, std::size_t first, std::size_t count, float* out) {
  for (std::size_t i = first; i < first + count; ++i, out += 3) {
    const auto v = bent_position(map, {points.w[i], points.x[i], points.y[i]}, points.z[i]);
    out[0] = static_cast<float>(v.x);
    out[1] = static_cast<float>(v.y);
    out[2] = static_cast<float>(v.z);
  }
}

}  // namespace orbc::bend
