#include "compiler/surface/specular.h"

#include <algorithm>
#include <cmath>

namespace orbc::surface {
namespace {

double cos_incident(geometry::Space space, const trace::SurfacePoint& point) {
  return std::clamp(-trace::inner(space, point.incoming, point.normal), 0.0, 1.0);
}

}  // namespace

trace::Direction reflect(geometry::Space space, const trace::SurfacePoint& point) {
  return point.incoming + (2 * cos_incident(space, point)) * point.normal;
}

Refraction refract(geometry::Space space, const trace::SurfacePoint& point, double index) {
  const double eta = point.front_facing ? index : 1 / index, cosine = cos_incident(space, point);
  const double sine2 = (1 - cosine * cosine) / (eta * eta);
  double transmitted = 0;  // cosine of the refracted ray; 0 at total reflection
  Refraction result;
  if (sine2 < 1) {
    transmitted = std::sqrt(1 - sine2);
    const double parallel = (eta * cosine - transmitted) / (eta * cosine + transmitted);
    const double across = (cosine - eta * transmitted) / (cosine + eta * transmitted);
    result.reflectance = (parallel * parallel + across * across) / 2;
  }
  result.direction = (1 / eta) * point.incoming + (cosine / eta - transmitted) * point.normal;
  return result;
}

}  // namespace orbc::surface
