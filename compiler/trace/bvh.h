#pragma once
// A bounding volume hierarchy for curved rays: rays that are geodesics of S²×R, E²×R or H²×R, spirals in every chart of the space.
//
// The paper (Zheng, Zhang, Zhang 2023, §8) leaves open which spatial structure serves non-Euclidean ray tracing. The answer built here: an
// ordinary BVH, in coordinates where half of the ray is straight, with the other half inverted instead of followed.
//
// 1. Boxes. The floor is seen in a gnomonic (Klein) chart, (ξ, η) = (x, y)/w around the chart's own centre; the box is an interval of ξ, of
//    η and of the height z. Floor geodesics are straight lines there, so the footprint of a geodesic triangle is a straight triangle and
//    lies in the box of its corners; its height is a convex combination of the corners' heights. Hence boxes are built like Euclidean ones,
//    without any bound on curvature, and an SAH builder needs no change.
// 2. Node test. Let Q be the foot of the perpendicular from the chart's centre to the ray's floor geodesic, T the direction there, s the
//    arc from Q and t = tanκ s (tan | id | tanh). The chart point is Q_xy/Q_w + t·T_xy/Q_w: affine in t, so two slabs are those of a
//    straight ray with the parameter t. The third, z, is linear in s, not in t; instead of computing z at both ends of the interval one
//    computes t at both planes: t_z = tanκ(s₀ + (z − z₀)·c/m). The three slabs are independent, and tanκ is an odd polynomial that
//    increases on all of ℝ (checked when the chart is made), so nothing is clamped. Cost over a straight ray: 8 to 12 operations for 8
//    boxes. Conservative, proof: planes are rounded outwards; the ray's constants are computed in double and rounded once, so a t of the
//    two chart slabs is wrong by less than a shift of the plane by 8 ulp of the chart's extent, and 16 are added; for |s₀ + …| ≤ radius the
//    polynomial is within `poly_error`, which is added; beyond it is larger (smaller) than any t in the chart because it increases.
// 3. Leaves: eight triangles in float, by chart_ray.h and judge-inl.h: the ray's line cuts two edges; how far each crossing lies above the
//    ray, c·z − m·atanκ(t) − const, gives a sign each. (Compared as t, by tanκ of the height, a flat ray would need tanκ of arguments far
//    beyond the chart: a quarter of the hits were unsure.) With bounds of the rounding and of the curve's bend a triangle is surely missed,
//    surely met once, or a case for double. The last word is always in double on the room's own coordinates (`exact::meet`, or
//    resolve-inl.h four at a time), so the tree finds exactly what trying all triangles finds (tests: 0 of 3,000,000 rays differ), and is
//    watertight because `meet` is.
// 4. Charts. S² shows less than a half in one gnomonic chart, and far charts of H² lose digits: chart.h makes one chart for each cluster of
//    triangles (rooms with three and more corners: one; lune and hemisphere: two and more; E²: one). A ray walks through each chart's tree.
// 5. Many rays at once: set up eight at a time and resolved four at a time in double (AVX2). Up to 64 that go nearly the same way are a fan
//    (fan-inl.h): what all of them may touch is looked for once, eight boxes deep in the tree become a root of their own. What a ray meets
//    depends neither on the order of the visits nor on where they begin, so it has the same bits alone, whatever its neighbours are.
// 6. No number of a tree is subnormal: a plane at the floor's z = 0 rounded outwards, or a product of a zero size, would be, and made
//    pictures a sixth slower.
//
// Figures (torus knot in right-angled rooms of equal size, 480,000 camera rays, per ray):
//                 12,480 triangles                 1,000,000 triangles
//         nodes   blocks   put to double   hits    nodes   blocks   put to double   hits
//   S²    5.86    1.99     0.65            0.64    8.31    1.78     0.66            0.64
//   E²    5.79    1.93     0.63            0.62    8.16    1.72     0.64            0.63
//   H²    5.63    1.93     0.62            0.61    7.98    1.68     0.63            0.61
// so a curved ray visits as many nodes as a straight one: the structure costs nothing, only the arithmetic of a node does. In streams a ray
// visits 1.8 to 1.9 nodes (3.5 to 3.7 of the million), its fan's own root among them, and finding that root costs 0.2 (0.3) nodes a ray.
//
// Rays per second over those of Embree 3.13 (rtcIntersect1, AVX2, straight rays, the room's walls by formula on both sides), one thread,
// rays in tiles of 16 x 16 pixels, medians interleaved in one process (scripts/bench); camera rays | rays between mirrors:
//                 12,480 triangles            1,000,000 triangles         curved over straight, streams
//         streams        singly         streams        singly         12,480         1,000,000
//   S²    0.66 | 0.66    0.37 | 0.36    0.67 | 0.66    0.42 | 0.41    0.80 | 0.77    0.85 | 0.82
//   E²    0.83 | 0.86    0.47 | 0.49    0.79 | 0.80    0.53 | 0.54
//   H²    0.66 | 0.69    0.37 | 0.37    0.67 | 0.68    0.43 | 0.41    0.80 | 0.79    0.84 | 0.84
// Two threads: 1.9 to 2.0 of one (by the busier one's CPU time). Tried without gain: large pages, prefetching nodes, blocks or corners,
// several walks in turn (with fans), AVX-512. Memory 96 to 100 bytes a triangle of a mesh with shared corners (nodes 224 bytes for 8
// children, blocks 448 bytes for 8 triangles, corners and indices in double for the last word); a million triangles are built in 0.8 s of
// CPU time.
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
  /// closest() for many rays at once, faster: hits[i].t says where the search for ray i ends.
  void closest_many(const Ray* rays, BvhHit* hits, std::size_t count) const;
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
