#pragma once
// A bounding volume hierarchy for curved rays, which are geodesics of S²×R, E²×R or H²×R.
//
// The paper (Zheng, Zhang, Zhang 2023, §8) leaves open which acceleration structure suits non-Euclidean ray tracing. This file answers: an
// ordinary BVH, in coordinates where the horizontal part of the ray is straight. The vertical part is not followed but inverted.
//
// 1. Boxes. The floor is mapped by a gnomonic (Klein) chart, (ξ, η) = (x, y)/w around the chart's own centre. A box is an interval of ξ, of
// η
//    and of the height z. Floor geodesics are straight lines in the chart, so the footprint of a geodesic triangle is a straight triangle
//    and lies in the box of its corners. Its height is a convex combination of the corners' heights. Boxes are therefore built like
//    Euclidean ones, without any bound on curvature, and an SAH builder needs no change.
// 2. Node test. Let Q be the foot of the perpendicular from the chart's centre to the ray's floor geodesic, T the direction there, s the
//    arc from Q and t = tanκ s (tan | id | tanh). The chart point is Q_xy/Q_w + t·T_xy/Q_w, affine in t, so two slab tests are those of
//    a straight ray with the parameter t. The third coordinate, z, is linear in s and not in t. Its slab test computes t at both planes:
//    t_z = tanκ(s₀ + (z − z₀)·c/m). The three slabs are independent, and tanκ is an odd polynomial that increases on all of ℝ (checked when
//    the chart is made), so nothing is clamped. The cost over a straight ray is 8 to 12 operations for 8 boxes. The test is conservative:
//    planes are rounded outwards. The ray's constants are computed in double and rounded once, so that a t of the two chart slabs is wrong
//    by less than a shift of the plane by 8 ulp of the chart's extent, and 16 ulp are added. For |s₀ + …| ≤ radius the polynomial is within
//    `tan_error`, which is added; beyond, it is larger (smaller) than any t in the chart because it increases.
// 3. Leaves hold eight triangles in float (chart_ray.h, classify-inl.h). The ray's line cuts two edges of a triangle. The sign of
//    f = c·z − m·atanκ(t) − const says on which side of the ray each crossing lies. (Comparing t with tanκ of the height instead would need
//    tanκ of arguments far beyond the chart for flat rays; then a quarter of the hits were undecided.) With bounds of the rounding and of
//    the curvature, a triangle is certainly missed, certainly hit once, or undecided. Hits are always computed in double in room
//    coordinates
//    (`exact::intersect_triangle`, or resolve-inl.h four at a time). The tree therefore finds exactly what testing all triangles finds
//    (tests: 0 of 3,000,000 rays differ), and it is watertight because `intersect_triangle` is.
// 4. Charts. One gnomonic chart covers less than half of S², and loses digits far from its centre on H². So chart_tree.h makes one chart
// for
//    each cluster of triangles (rooms with three and more corners: one; lune and hemisphere: two and more; E²: one). A ray traverses the
//    tree of every chart.
// 5. Streams of rays are set up eight at a time and resolved four at a time in double (AVX2). Up to 64 rays with similar directions form a
//    packet (packet-inl.h). The boxes that any of them may intersect are found once: eight boxes deep in the tree become the packet's own
//    root. A hit depends neither on the order of the visits nor on the node where they begin, so a ray has the same hit, bit by bit, alone
//    and in a packet.
// 6. No number in a tree is subnormal. A plane at the floor's z = 0 rounded outwards, or the product with a zero size, would be, and made
//    rendering a sixth slower.
//
// Figures (torus knot in right-angled rooms of equal size, 480,000 camera rays, per ray):
//                 12,480 triangles                 1,000,000 triangles
//         nodes   blocks   tested exactly  hits    nodes   blocks   tested exactly  hits
//   S²    5.86    1.99     0.65            0.64    8.31    1.78     0.66            0.64
//   E²    5.79    1.93     0.63            0.62    8.16    1.72     0.64            0.63
//   H²    5.63    1.93     0.62            0.61    7.98    1.68     0.63            0.61
// A curved ray visits as many nodes as a straight one, so only the arithmetic of a node costs more. In streams a ray visits 1.8 to 1.9
// nodes (3.5 to 3.7 with a million triangles), its packet's own root included, and finding that root costs 0.2 (0.3) nodes a ray.
//
// Rays per second over those of Embree 3.13 (rtcIntersect1, AVX2, straight rays, the room's walls by formula on both sides), one thread,
// rays in tiles of 16 x 16 pixels, medians interleaved in one process (scripts/bench); camera rays | rays between mirrors:
//                 12,480 triangles            1,000,000 triangles         curved over straight, streams
//         streams        singly         streams        singly         12,480         1,000,000
//   S²    0.66 | 0.66    0.37 | 0.36    0.67 | 0.66    0.42 | 0.41    0.80 | 0.77    0.85 | 0.82
//   E²    0.83 | 0.86    0.47 | 0.49    0.79 | 0.80    0.53 | 0.54
//   H²    0.66 | 0.69    0.37 | 0.37    0.67 | 0.68    0.43 | 0.41    0.80 | 0.79    0.84 | 0.84
// Two threads: 1.9 to 2.0 of one (by the busier one's CPU time). Measured without gain: large pages, prefetching nodes, blocks or corners,
// interleaved traversals (with packets), AVX-512. Memory: 96 to 100 bytes a triangle of a mesh with shared vertices (nodes of 224 bytes for
// 8 children, blocks of 448 bytes for 8 triangles, vertices in double and indices). A million triangles are built in 0.8 s of CPU time.
#include <memory>
#include <vector>

#include "compiler/base/executor.h"
#include "compiler/trace/bvh/chart_tree.h"
#include "compiler/trace/bvh/scene_triangles.h"

namespace orbc::trace {

struct BvhHit {
  std::uint32_t triangle = kNoTriangle;  ///< index into SceneTriangles::corners
  double t = kInfinity;
  double b[3] = {0, 0, 0};  ///< affine barycentric coordinates
};

/// Work done for rays: the figures above, and what the tests of the pruning check.
struct BvhCounts {
  std::uint64_t nodes = 0, blocks = 0, candidates = 0;
};

class Bvh {
 public:
  /// Same tree for any number of threads.
  Bvh(geometry::Space space, SceneTriangles scene, const Executor& execute);

  /// The first hit with t_min < t < t_max. In: on S², t_max is at most half a revolution, π/c.
  [[nodiscard]] BvhHit closest(const Ray& ray, double t_max) const;
  [[nodiscard]] bool occluded(const Ray& ray, double t_max) const;
  /// closest() for many rays at once, faster. In: hits[i].t is t_max of ray i.
  void closest_many(const Ray* rays, BvhHit* hits, std::size_t count) const;
  /// closest() that also counts the nodes and blocks it visits.
  [[nodiscard]] BvhHit closest_counted(const Ray& ray, double t_max, BvhCounts& counts) const;

  [[nodiscard]] geometry::Space space() const { return space_; }
  [[nodiscard]] const SceneTriangles& triangles() const { return triangles_; }
  [[nodiscard]] const std::vector<ChartTree>& charts() const { return charts_; }
  [[nodiscard]] const std::vector<std::uint32_t>& uncharted() const { return uncharted_; }
  [[nodiscard]] double height_bound() const { return height_; }
  /// Memory of nodes, blocks, vertices and indices.
  [[nodiscard]] std::size_t bytes() const;

 private:
  void intersect_uncharted(const Ray& ray, BvhHit& best) const;

  geometry::Space space_;
  SceneTriangles triangles_;
  std::vector<ChartTree> charts_;
  std::vector<std::uint32_t> uncharted_;
  double height_ = 0;  ///< largest |z| of a vertex
};

/// Builds the nodes and blocks of one chart over the given triangles of the scene (build.cpp).
void build_tree(const SceneTriangles& scene, const std::vector<std::uint32_t>& triangles, const Executor& execute, ChartTree& chart);

}  // namespace orbc::trace
