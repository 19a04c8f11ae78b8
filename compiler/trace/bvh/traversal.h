#pragma once
#include "compiler/trace/bvh/bvh.h"

namespace orbc::trace {

/// Rays to traverse one chart's tree: the input of the kernels of all instruction sets.
struct TraversalBatch {
  geometry::Space space = geometry::Space::euclidean;
  const SceneTriangles* triangles = nullptr;
  const ChartTree* chart = nullptr;
  const Ray* rays = nullptr;
  double height_bound = 0;      ///< largest |z| of a vertex
  BvhHit* best = nullptr;       ///< per ray. In: t is the end of the search. Out: the nearest hit before that, if there is one
  BvhCounts* counts = nullptr;  ///< for counting traversals only
  std::size_t count = 1;        ///< number of rays
};

/// A triangle that is certainly hit exactly once, and whose hit point is not yet computed.
struct DeferredHit {
  std::uint32_t triangle = kNoTriangle;
  float guess = 0;                 ///< approximate u between the two edges that the ray's plane cuts
  float t_lower = 0, t_upper = 0;  ///< bounds of the hit's t in the chart
};

}  // namespace orbc::trace
