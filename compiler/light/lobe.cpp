// Everything local is that of Euclidean space: in an orthonormal frame with the surface's normal upwards.
#include "compiler/light/lobe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/light/frame.h"

namespace orbc::light {
namespace {

using geometry::Vector3;
using scene::Color;

constexpr double kSmoothest = 0.002;  // α: of what is smoother no float can tell the lobe

// A facet's normal, chosen among those that are seen from `eye`.
Vector3 seen_facet(const Vector3& eye, double alpha, const std::array<double, 2>& u) {
  const Vector3 stretched = geometry::normalised({alpha * eye.x, alpha * eye.y, eye.z});
  const double flat = std::hypot(stretched.x, stretched.y);
  const Vector3 across = flat > 1e-12 ? Vector3{-stretched.y / flat, stretched.x / flat, 0} : Vector3{1, 0, 0};
  const Vector3 other = cross(stretched, across);
  const double r = std::sqrt(u[0]), phi = 2 * std::numbers::pi * u[1], half = 0.5 * (1 + stretched.z);
  const double x = r * std::cos(phi), y = (1 - half) * std::sqrt(std::max(0.0, 1 - x * x)) + half * r * std::sin(phi);
  const Vector3 n = x * across + y * other + std::sqrt(std::max(0.0, 1 - x * x - y * y)) * stretched;
  return geometry::normalised({alpha * n.x, alpha * n.y, std::max(1e-9, n.z)});
}

}  // namespace

double facet_width(const scene::Material& material) { return std::max(material.roughness * material.roughness, kSmoothest); }

double facet_density(double cosine, double a2) {
  const double base = cosine * cosine * (a2 - 1) + 1;
  return a2 / (std::numbers::pi * base * base);
}

double facets_seen(double cosine, double a2) { return 2 * cosine / (cosine + std::sqrt(a2 + (1 - a2) * cosine * cosine)); }

Color reflectance(const Color& face_on, double cosine) {
  const double t = 1 - std::clamp(cosine, 0.0, 1.0), t2 = t * t, graze = t2 * t2 * t;
  return (1 - graze) * face_on + graze * Color{1, 1, 1};
}

Color face_on(const scene::Material& material, const Color& albedo) {
  if (material.kind == scene::MaterialKind::metal) return albedo;
  const double f = std::pow((material.index - 1) / (material.index + 1), 2);
  return {f, f, f};
}

Glance glance(geometry::Space space, const trace::SurfacePoint& point, double alpha, const std::array<double, 2>& u) {
  const Frame floor = frame_at(space, point.at.floor);
  const Vector3 n = geometry::normalised(local(space, floor, point.normal)), to_eye = -1.0 * local(space, floor, point.arriving);
  const Vector3 across = geometry::normalised(cross(std::fabs(n.z) < 0.9 ? Vector3{0, 0, 1} : Vector3{1, 0, 0}, n)),
                other = cross(n, across);
  const Vector3 eye{dot(to_eye, across), dot(to_eye, other), std::max(1e-6, dot(to_eye, n))};
  const Vector3 facet = seen_facet(eye, alpha, u);
  Glance result;
  result.cosine = std::clamp(dot(eye, facet), 0.0, 1.0);
  const Vector3 way = (2 * result.cosine) * facet - eye;
  if (way.z <= 0) return result;
  result.weight = facets_seen(way.z, alpha * alpha);
  result.direction = global(floor, geometry::normalised(way.x * across + way.y * other + way.z * n));
  return result;
}

}  // namespace orbc::light
