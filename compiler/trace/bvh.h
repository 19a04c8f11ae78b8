#pragma once
#include <memory>
#include <vector>

#include "compiler/base/executor.h"
#include "compiler/trace/chart.h"
#include "compiler/trace/soup.h"

namespace orbc::trace {

struct BvhHit {
  std::uint32_t triangle = kNone;   ///< index into Soup::triangles
  double t = kEndless;
  double b[3] = {0, 0, 0};
};

/// Work done for rays, for the figures above and for tests of the pruning.
struct BvhCounts {
  std::uint64_t nodes = 0, blocks = 0, candidates = 0;
};

class Bvh {
 public:
  /// Same tree for any number of threads.
  Bvh(geometry::Space space, Soup soup, const Executor& execute);

  /// The first triangle met with t_min < t < t_max. S²: t_max must not exceed half a turn, π/c.
  [[nodiscard]] BvhHit closest(const Ray& ray, double t_max) const;
  [[nodiscard]] bool occluded(const Ray& ray, double t_max) const;
  /// closest() that counts what it visits.
  [[nodiscard]] BvhHit closest_counted(const Ray& ray, double t_max, BvhCounts& counts) const;

  [[nodiscard]] geometry::Space space() const { return space_; }
  [[nodiscard]] const Soup& soup() const { return soup_; }
  [[nodiscard]] const std::vector<Chart>& charts() const { return charts_; }
  [[nodiscard]] const std::vector<std::uint32_t>& large() const { return large_; }
  [[nodiscard]] double height_bound() const { return height_; }
  /// Nodes, blocks, corners and indices together.
  [[nodiscard]] std::size_t bytes() const;

 private:
  void try_large(const Ray& ray, BvhHit& best) const;

  geometry::Space space_;
  Soup soup_;
  std::vector<Chart> charts_;
  std::vector<std::uint32_t> large_;
  double height_ = 0;               ///< largest |z| of a corner
};

/// Builds the nodes and blocks of one chart over `triangles` of the soup (bvh_build.cpp).
void build_tree(const Soup& soup, const std::vector<std::uint32_t>& triangles, const Executor& execute, Chart& chart);

}  // namespace orbc::trace
