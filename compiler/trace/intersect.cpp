#include "compiler/trace/intersect.h"

#include "compiler/trace/intersect_exact.h"

namespace orbc::trace {

using geometry::Space;

TriangleHit intersect(const RayPlane& plane, const Vertex& a, const Vertex& b, const Vertex& c, double t_max) {
  const Vertex* const vertex[3] = {&a, &b, &c};
  if (plane.space == Space::euclidean) return exact::intersect_triangle<Space::euclidean>(plane, vertex, t_max);
  return plane.space == Space::spherical ? exact::intersect_triangle<Space::spherical>(plane, vertex, t_max)
                                         : exact::intersect_triangle<Space::hyperbolic>(plane, vertex, t_max);
}

}  // namespace orbc::trace
