// Nearest point of a triangle: Ericson, Real-Time Collision Detection (2005), 5.1.5, by the regions of its corners, edges and face.
#include "compiler/driver/renderer_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "compiler/base/elementary.h"
#include "compiler/geometry/chart.h"

namespace orbc::driver {
namespace {

using geometry::Vector3;

constexpr double kMinDistance = 1.0 / 64, kTargetDistance = 1.0 / 32;
constexpr double kMaxDistance = 524288;            // 2^19
constexpr double kMinVisibleDistance = 1.0 / 512;  // twice POV-Ray's smallest depth
constexpr int kMaxExponent = 64;                   // of the scale where the nearest surface touches the eye

Vector3 eye_of(const Product& product) {
  if (!product.disk_view) return {0, 0, product.eye.z};
  const geometry::Isometry& map = product.eye.room_from_eye;
  const std::complex<double> at = product.chart_scale * geometry::disk_from_point(map.space, map * geometry::Point());
  return {at.real(), at.imag(), product.eye.z};
}

double square(const Vector3& v) { return geometry::dot(v, v); }

/// The square of the distance from the origin to a segment.
double to_segment(const Vector3& a, const Vector3& b) {
  const Vector3 ab = b - a;
  const double length = square(ab), t = length > 0 ? std::clamp(-geometry::dot(a, ab) / length, 0.0, 1.0) : 0;
  return square(a + t * ab);
}

/// The square of the distance from the origin to a triangle.
double to_triangle(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 normal = geometry::cross(b - a, c - a);
  const double size = square(normal);
  const auto left_of = [&](const Vector3& p, const Vector3& q) { return geometry::dot(normal, geometry::cross(p, q)) >= 0; };
  if (size > 0 && left_of(a, b) && left_of(b, c) && left_of(c, a)) {
    const double height = geometry::dot(normal, a);
    return height * height / size;
  }
  return std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
}

/// The square of the distance from the origin to the box around a triangle: at most that to the triangle.
double to_box(const Vector3& a, const Vector3& b, const Vector3& c) {
  const auto gap = [](double x, double y, double z) { return std::max({0.0, std::min({x, y, z}), -std::max({x, y, z})}); };
  return square({gap(a.x, b.x, c.x), gap(a.y, b.y, c.y), gap(a.z, b.z, c.z)});
}

}  // namespace

Distances distances_from_eye(const Product& product) {
  const Vector3 eye = eye_of(product);
  const auto from_eye = [&](std::uint32_t i) {
    const auto& p = product.positions[i];
    return Vector3{p[0] - eye.x, p[1] - eye.y, p[2] - eye.z};
  };
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
  for (std::size_t i = 0; i + 2 < product.indices.size(); i += 3) {
    const Vector3 a = from_eye(product.indices[i]), b = from_eye(product.indices[i + 1]), c = from_eye(product.indices[i + 2]);
    farthest = std::max({farthest, square(a), square(b), square(c)});
    if (to_box(a, b, c) < nearest) nearest = std::min(nearest, to_triangle(a, b, c));
  }
  if (product.indices.empty()) return {};
  return {std::sqrt(nearest), std::sqrt(farthest)};
}

double renderer_scale(const Distances& d) {
  if (!(d.farthest > 0) || (d.nearest >= kMinDistance && d.farthest <= kMaxDistance)) return 1;
  int up = 0;
  if (d.nearest < kMinDistance) up = d.nearest > 0 ? static_cast<int>(std::ceil(math::log2(kTargetDistance / d.nearest))) : kMaxExponent;
  const int most = static_cast<int>(std::floor(math::log2(kMaxDistance / d.farthest)));
  return std::ldexp(1.0, std::min(up, most));
}

Diagnostics scale_for_renderers(Product& product) {
  const Distances d = distances_from_eye(product);
  const double scale = renderer_scale(d);
  product.scale = scale;
  if (scale != 1) {
    const auto factor = static_cast<float>(scale);
    for (auto& p : product.positions) p = {factor * p[0], factor * p[1], factor * p[2]};
    if (product.native) {
      for (native_lights::NativeLamp& lamp : product.native->lamps) {
        lamp.at = scale * lamp.at;
        lamp.half_u = scale * lamp.half_u;
        lamp.half_v = scale * lamp.half_v;
        if (lamp.inverse_square) lamp.intensity = scale * scale * lamp.intensity;
      }
    }
  }
  if (product.indices.empty() || scale * d.nearest >= kMinVisibleDistance) return {};
  return {make_warning("driver.eye-too-near",
                       fmt::format("the eye is {:.2g} from the nearest surface, and the farthest is {:.2g} away: renderers do not see both",
                                   d.nearest, d.farthest),
                       "move the eye away from it, or draw the scene with the tracer")};
}

}  // namespace orbc::driver
