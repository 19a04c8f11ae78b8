#pragma once
#include "compiler/trace/bvh.h"

namespace orbc::trace {

/// Rays to walk through one chart's tree: what the kernels of all instruction sets are given.
struct Walk {
  geometry::Space space = geometry::Space::euclidean;
  const Soup* soup = nullptr;
  const Chart* chart = nullptr;
  const Ray* ray = nullptr;
  double height_bound = 0;
  BvhHit* best = nullptr;           ///< per ray. In: t is the end of the search; out: the nearest triangle, if one is met before
  BvhCounts* counts = nullptr;
  std::size_t count = 1;            ///< of rays
};

/// A triangle that is surely met exactly once, still without its point.
struct Pending {
  std::uint32_t triangle = kNone;
  float guess = 0;                  ///< where on the way between the two edges that the ray's plane cuts
  float nearer = 0, farther = 0;    ///< bounds of t
};

}  // namespace orbc::trace
