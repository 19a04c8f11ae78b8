#include "compiler/place/distortion.h"

#include <algorithm>
#include <cmath>

#include "compiler/base/elementary.h"
#include "compiler/geometry/point.h"

namespace orbc::place {
namespace {

double angle_between_stretches(double p, double q) { return 2 * math::asin(std::fabs(p - q) / (p + q)); }

}  // namespace

EmbeddingDistortion embedding_distortion(geometry::Space space, scene::Embedding embedding, double reach) {
  EmbeddingDistortion distortion{reach};
  if (space == geometry::Space::euclidean || reach == 0) return distortion;
  double outermost = 1;
  if (embedding == scene::Embedding::exponential) {
    outermost = geometry::sin_k(space, reach) / reach;
    distortion.angle = angle_between_stretches(outermost, 1);
  } else {
    outermost = 1 - geometry::curvature(space) * geometry::sin_k(space, reach / 2) * geometry::sin_k(space, reach / 2);
  }
  distortion.least_scale = std::min(1.0, outermost);
  distortion.largest_scale = std::max(1.0, outermost);
  distortion.upright_angle = angle_between_stretches(outermost, 1);
  return distortion;
}

double reach_of(const PlacedMesh& object, geometry::Space space, const geometry::Point& axis) {
  double reach = 0;
  for (const geometry::Point& x : object.floor) reach = std::max(reach, geometry::distance(space, axis, x));
  return reach;
}

}  // namespace orbc::place
