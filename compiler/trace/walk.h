#pragma once
#include "compiler/trace/bvh.h"

namespace orbc::trace {

/// One ray's walk through one chart's tree: what the kernels of all instruction sets are given.
struct Walk {
  const Soup* soup = nullptr;
  const Chart* chart = nullptr;
  const Ray* ray = nullptr;
  double height_bound = 0;
  BvhHit* best = nullptr;           ///< in: t is the end of the search; out: the nearest triangle, if one is met before
  BvhCounts* counts = nullptr;
};

}  // namespace orbc::trace
