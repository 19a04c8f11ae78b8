#include "compiler/surface/specular.h"

#include <algorithm>
#include <cmath>

namespace orbc::surface {
namespace {

// Share of light that a boundary of relative index `eta` (to / from) reflects, and the cosine of the refracted ray; 1 at total reflection.
double fresnel(double cosine, double eta, double& refracted) {
  const double sine2 = (1 - cosine * cosine) / (eta * eta);
  if (sine2 >= 1) return 1;
  refracted = std::sqrt(1 - sine2);
  const double parallel = (eta * cosine - refracted) / (eta * cosine + refracted);
  const double across = (cosine - eta * refracted) / (cosine + eta * refracted);
  return (parallel * parallel + across * across) / 2;
}

double cosine_at(const trace::TraceScene& scene, const trace::SurfacePoint& point) {
  return std::clamp(-trace::inner(scene.room->room.space, point.arriving, point.normal), 0.0, 1.0);
}

}  // namespace

trace::Direction mirrored(const trace::TraceScene& scene, const trace::SurfacePoint& point) {
  return point.arriving + (2 * cosine_at(scene, point)) * point.normal;
}

Refraction refracted(const trace::TraceScene& scene, const trace::SurfacePoint& point, double index) {
  const double eta = point.outside ? index : 1 / index, cosine = cosine_at(scene, point);
  double onward = 0;
  Refraction result;
  result.reflectance = fresnel(cosine, eta, onward);
  result.direction = (1 / eta) * point.arriving + (cosine / eta - onward) * point.normal;
  return result;
}

}  // namespace orbc::surface
