#pragma once
#include <cmath>
#include <complex>

#include "compiler/driver/product.h"
#include "compiler/geometry/chart.h"

namespace orbc::exporters {

/// Where the camera of a product stands among its meshes, and where it looks: orthonormal, right = forward × up, z up.
struct Standpoint {
  geometry::Vector3 location, forward, right, up;
};

/// In:      a product; bent ones have the eye above the origin, flat ones (`--view disk`, straight rays) at its own
///          place in the disk chart; both at the product's scale.
/// Formula: the chart map z ↦ (az + b)/(−κ b̄ z + ā) has the derivative 1/ā² at 0, so directions turn by arg a².
[[nodiscard]] inline Standpoint standpoint(const driver::Product& product) {
  const place::Camera& eye = product.eye;
  if (!product.disk_view) return {{0, 0, product.scale * eye.z}, eye.forward, eye.right, eye.up};
  const geometry::Isometry& map = eye.room_from_eye;
  const std::complex<double> at = product.chart_scale * geometry::disk_from_point(map.space, map * geometry::Point());
  const std::complex<double> turn = map.a * map.a / std::norm(map.a);
  const auto turned = [&](const geometry::Vector3& v) {
    const std::complex<double> horizontal = turn * std::complex<double>(v.x, v.y);
    return geometry::Vector3{horizontal.real(), horizontal.imag(), v.z};
  };
  return {product.scale * geometry::Vector3{at.real(), at.imag(), eye.z}, turned(eye.forward), turned(eye.right), turned(eye.up)};
}

}  // namespace orbc::exporters
