#include "compiler/geometry/chart.h"

#include <cmath>

#include "compiler/base/elementary.h"

namespace orbc::geometry {

std::complex<double> disk_from_point(Space space, const Point& p) {
  if (space == Space::euclidean) return {p.x, p.y};
  if (p.w < 0) {
    // Near the antipode 1 + w has lost its digits, (1 − w)/ρ² has not.
    const double s = (1 - p.w) / (p.x * p.x + p.y * p.y);
    return {p.x * s, p.y * s};
  }
  return {p.x / (1 + p.w), p.y / (1 + p.w)};
}

Point point_from_disk(Space space, std::complex<double> z) {
  if (space == Space::euclidean) return {1, z.real(), z.imag()};
  const double k = curvature(space), n = std::norm(z), s = 1 / (1 + k * n);
  return {(1 - k * n) * s, 2 * z.real() * s, 2 * z.imag() * s};
}

std::complex<double> gnomonic_from_point(const Point& p) { return {p.x / p.w, p.y / p.w}; }

std::complex<double> log_from_point(Space space, const Point& p) {
  const double rho = math::hypot(p.x, p.y);
  if (rho == 0) return {0, 0};
  const double scale = arc_k(space, p.w, rho) / rho;
  return {p.x * scale, p.y * scale};
}

Point point_from_log(Space space, std::complex<double> z) {
  const double r = math::abs(z);
  if (r == 0) return {};
  const double scale = sin_k(space, r) / r;
  return {cos_k(space, r), z.real() * scale, z.imag() * scale};
}

std::complex<double> axial_from_point(Space space, const Point& p) {
  if (space == Space::spherical) return {math::atan2(p.x, p.w), math::atan2(p.y, p.w)};
  return {atan_k(space, p.x / p.w), atan_k(space, p.y / p.w)};
}

Point point_from_axial(Space space, std::complex<double> uv) {
  return normalised_point(space, {1, tan_k(space, uv.real()), tan_k(space, uv.imag())});
}

}  // namespace orbc::geometry
