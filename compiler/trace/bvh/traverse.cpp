// Traversal of the tree: the SIMD kernels, compiled once per instruction set by Highway and chosen at run time for a whole call. Float
// decides only which triangles are certainly missed and which are certainly hit once. The others are intersected in double (see bvh.h).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compiler/trace/bvh/traverse.cpp"
// AVX-512 was measured to gain nothing here (a node has eight children). Processors with SSSE3 and without SSE4 (2006) take the SSE2
// kernel.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3 | HWY_AVX3_DL)
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "compiler/trace/bvh/chart_ray.h"
#include "compiler/trace/bvh/classify-inl.h"
#include "compiler/trace/bvh/packet-inl.h"
#include "compiler/trace/bvh/ray_setup-inl.h"
#include "compiler/trace/bvh/resolve-inl.h"
#include "compiler/trace/bvh/traversal.h"
#include "compiler/trace/intersect_exact.h"

HWY_BEFORE_NAMESPACE();
namespace orbc::trace::HWY_NAMESPACE {

/// The chart's t of a hit on a triangle of the block, rounded up: the search can end there.
HWY_INLINE float chart_t_of_hit(const Block8& block, int lane, const ChartRay& ray, const BvhHit& hit) {
  float sum = 0, weights = 0;
  for (int i = 0; i < 3; ++i) {
    const float weight = static_cast<float>(hit.b[i]) / block.by_w[i][lane];
    sum += weight * (ray.t_x * block.x[i][lane] + ray.t_y * block.y[i][lane]);
    weights += weight;
  }
  const float t = sum / weights;
  return t + 2 * ray.t_error + 4e-6f * std::fabs(t);
}

/// A child on the stack: the sort key of the t at which the ray entry_t it in the upper half, and its index in the lower half.
using StackEntry = std::uint64_t;

/// An integer with the same order as t.
HWY_INLINE std::uint32_t sort_key(float t) {
  std::uint32_t bits;
  std::memcpy(&bits, &t, 4);
  return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

HWY_INLINE void sort(StackEntry& a, StackEntry& b) {  // the nearer one becomes b, the upper one on the stack
  const StackEntry near = a < b ? a : b;
  a = a < b ? b : a;
  b = near;
}

/// The child to visit next, and the end of the stack with the others.
struct StackTop {
  std::uint32_t child = 0;
  StackEntry* top = nullptr;
};

/// State that only rays with intersections in double need.
struct ExactState {
  RayPlane plane;
  BvhHit before;  ///< the best hit before the first intersection in double
};

/// The traversal of one tree by one ray. Its result does not depend on the order in which nodes and blocks are visited, nor on the node
/// where it starts, so a ray has the same hit, bit by bit, alone and in a packet.
template <Space kSpace, int kTerms, bool kAnyHit, bool kCount>
struct Traversal {
  ChartRay& ray;
  const Ray& room_ray;
  BvhHit& best;
  /// The nearest certain hit. It is computed in double after the traversal, or earlier to be compared with another triangle's.
  DeferredHit& deferred;
  ExactState& exact_state;
  StackEntry* const stack;
  bool exact = false, found = false;

  HWY_INLINE bool pop(StackTop& next) const {
    const std::uint32_t end = sort_key(ray.t_end);
    while (next.top != stack) {
      const StackEntry entry = *--next.top;
      if (static_cast<std::uint32_t>(entry >> 32) > end) continue;
      next.child = static_cast<std::uint32_t>(entry);
      return true;
    }
    return false;
  }

  /// Moves to the nearest intersected child and pushes the others, the nearer on top. Makes: false if no child is intersected.
  HWY_INLINE bool visit_node(const TraversalBatch& batch, const Node8& node, StackTop& next) {
    if constexpr (kCount) ++batch.counts->nodes;
    alignas(32) float entry_t[8];
    std::uint32_t bits = intersected_children<kTerms>(node, *batch.chart, ray, ray.t_end, entry_t);
    if (bits == 0) return false;
    const int first = lowest_bit(bits);
    bits &= bits - 1;
    next.child = node.child[first];
    if (bits == 0) return true;
    const auto entry = [&](int lane) { return static_cast<StackEntry>(sort_key(entry_t[lane])) << 32 | node.child[lane]; };
    StackEntry a = entry(first), b = entry(lowest_bit(bits));
    bits &= bits - 1;
    sort(a, b);
    next.child = static_cast<std::uint32_t>(b);
    *next.top++ = a;
    if (bits == 0) return true;
    StackEntry* const base = next.top - 1;
    *next.top++ = b;
    do {  // insertion sort: rarely more than one or two are left
      StackEntry other = entry(lowest_bit(bits));
      bits &= bits - 1;
      StackEntry* at = next.top++;
      for (; at > base && at[-1] < other; --at) *at = at[-1];
      *at = other;
    } while (bits);
    next.child = static_cast<std::uint32_t>(*--next.top);
    return true;
  }

  /// Intersects a triangle in double. Makes: whether it is hit before the best hit so far; of two hits with the same t the lower index
  /// wins. In: `certain`: the triangle is certainly hit once. `deferrable`: also far from the ray's ends, so that resolve_many computes the
  /// point.
  HWY_INLINE bool intersect_exactly(const TraversalBatch& batch, const DeferredHit& triangle, bool certain, bool deferrable) {
    const auto& v = batch.triangles->corners[triangle.triangle];
    const Vertex* vertices = batch.triangles->vertices.data();
    const Vertex* const corners[3] = {vertices + v[0], vertices + v[1], vertices + v[2]};
    const double end = found ? std::nextafter(best.t, kInfinity) : best.t;
    const TriangleHit hit = certain && kSpace != Space::euclidean
                                ? trace::exact::refine_hit<kSpace>(exact_state.plane, corners, end, triangle.guess)
                                : trace::exact::intersect_triangle<kSpace>(exact_state.plane, corners, end);
    if (!hit.found || (found && hit.t == best.t && triangle.triangle > best.triangle)) return false;
    best = {triangle.triangle, hit.t, {hit.b[0], hit.b[1], hit.b[2]}};
    deferred = triangle;
    if (!deferrable) deferred.triangle = kNoTriangle;
    return found = true;
  }

  /// From here on, triangles are intersected in double.
  HWY_INLINE void begin_exact(const TraversalBatch& batch) {
    if (exact) return;
    exact = true;
    exact_state = {plane_of(kSpace, room_ray), best};
    if (deferred.triangle != kNoTriangle) intersect_exactly(batch, DeferredHit(deferred), true, true);
  }

  /// If the nearest hit is still deferred, `best` is reset to the best hit before.
  HWY_INLINE void finish() {
    if (exact && deferred.triangle != kNoTriangle) best = exact_state.before;
  }

  /// Tests the triangles of a block. Makes: false if any hit is wanted and one is found.
  HWY_INLINE bool visit_block(const TraversalBatch& batch, std::uint32_t child) {
    const Block8& block = batch.chart->blocks[child & ~kBlockFlag];
    if constexpr (kCount) ++batch.counts->blocks;
    LeafResult leaf;
    classify_block<kSpace>(block, *batch.chart, ray, leaf);
    for (std::uint32_t bits = leaf.candidates; bits; bits &= bits - 1) {
      const int lane = lowest_bit(bits);
      const std::uint32_t triangle = block.triangle[lane];
      if (triangle == kNoTriangle) continue;
      if constexpr (kCount) ++batch.counts->candidates;
      const bool certain = leaf.certainly_hit >> lane & 1;
      const float near = leaf.t_lower[lane], far = leaf.t_upper[lane], f = leaf.f_first[lane];
      const float guess = f / (f - leaf.f_second[lane]);
      const bool deferrable = certain && near > ray.certain_after && far < ray.certain_before;
      if (deferrable && !exact) {
        if constexpr (kAnyHit) {
          found = true;
          return false;
        }
        if (deferred.triangle != kNoTriangle && near > deferred.t_upper) continue;
        if (deferred.triangle == kNoTriangle || far < deferred.t_lower) {
          deferred = {triangle, guess, near, far};
          hwy::Prefetch(&batch.triangles->corners[triangle]);  // prefetching nodes and blocks was measured to cost more than it saves
          ray.t_end = std::min(ray.t_end, far);
          continue;
        }
      }
      begin_exact(batch);  // two triangles, or a triangle and an end of the ray, are too close to be ordered in float
      if (!intersect_exactly(batch, {triangle, guess, near, far}, certain, deferrable)) continue;
      if constexpr (kAnyHit) return false;
      ray.t_end = std::min(ray.t_end, certain ? far : chart_t_of_hit(block, lane, ray, best));
    }
    return true;
  }
};

/// Traverses the tree with all rays of the batch, kMaxRays at a time: sets them up eight at a time, starts them at their packet's node, and
/// resolves deferred hits four at a time. Single rays take the same path, so that they give the same bits as in a stream.
/// Makes: whether a hit was found, for kAnyHit; else false.
template <Space kSpace, int kTerms, bool kAnyHit, bool kCount, std::size_t kMaxRays>
bool traverse_batch(const TraversalBatch& batch) {
  constexpr std::size_t kMinPacketRays = 8;
  ChartRay rays[kMaxRays];
  DeferredHit deferred[kMaxRays];
  ExactState exact_state;
  StackEntry stack[8 * kMaxTreeDepth];
  for (std::size_t first = 0; first < batch.count; first += kMaxRays) {
    const std::size_t count = std::min(kMaxRays, batch.count - first);
    for (std::size_t i = 0; i < count; i += 8) set_up_rays<kSpace>(batch, first + i, std::min<std::size_t>(8, count - i), rays + i);
    Node8 packet_root;
    const Node8* root = batch.chart->nodes.data();
    if (count >= kMinPacketRays) {
      const PacketEntry entry = find_packet_entry<kSpace>(*batch.chart, rays, count, packet_root);
      if (entry == PacketEntry::none) continue;
      if (entry == PacketEntry::own_node) root = &packet_root;
    }
    for (std::size_t i = 0; i < count; ++i) {
      deferred[i].triangle = kNoTriangle;
      if (rays[i].misses) continue;
      Traversal<kSpace, kTerms, kAnyHit, kCount> traversal{rays[i],     batch.rays[first + i], batch.best[first + i],
                                                           deferred[i], exact_state,           stack};
      StackTop next{0, traversal.stack};
      bool has_child = traversal.visit_node(batch, *root, next);
      do {
        while (has_child && !(next.child & kBlockFlag)) has_child = traversal.visit_node(batch, batch.chart->nodes[next.child], next);
        if (has_child && !traversal.visit_block(batch, next.child)) return true;
        has_child = true;
      } while (traversal.pop(next));
      traversal.finish();
    }
    if constexpr (!kAnyHit) resolve_many<kSpace>(batch, first, count, deferred);
  }
  return false;
}

template <Space kSpace, int kTerms, bool kAnyHit, bool kCount>
bool traverse_in_packets(const TraversalBatch& batch) {
  if constexpr (!kAnyHit && !kCount) {
    if (batch.count > 1) return traverse_batch<kSpace, kTerms, kAnyHit, kCount, kMaxPacketRays>(batch);
  }
  return traverse_batch<kSpace, kTerms, kAnyHit, kCount, 1>(batch);
}

template <bool kAnyHit, bool kCount>
bool traverse_chart(const TraversalBatch& batch) {
  const int terms = batch.chart->tan_terms;
  if (batch.space == Space::euclidean) return traverse_in_packets<Space::euclidean, 1, kAnyHit, kCount>(batch);
  if (batch.space == Space::spherical)
    return terms == 2   ? traverse_in_packets<Space::spherical, 2, kAnyHit, kCount>(batch)
           : terms == 4 ? traverse_in_packets<Space::spherical, 4, kAnyHit, kCount>(batch)
                        : traverse_in_packets<Space::spherical, 7, kAnyHit, kCount>(batch);
  return terms == 3   ? traverse_in_packets<Space::hyperbolic, 3, kAnyHit, kCount>(batch)
         : terms == 5 ? traverse_in_packets<Space::hyperbolic, 5, kAnyHit, kCount>(batch)
                      : traverse_in_packets<Space::hyperbolic, 7, kAnyHit, kCount>(batch);
}

bool traverse_closest(const TraversalBatch& batch) { return traverse_chart<false, false>(batch); }
bool traverse_any(const TraversalBatch& batch) { return traverse_chart<true, false>(batch); }
bool traverse_counted(const TraversalBatch& batch) { return traverse_chart<false, true>(batch); }

}  // namespace orbc::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace orbc::trace {

HWY_EXPORT(traverse_closest);
HWY_EXPORT(traverse_any);
HWY_EXPORT(traverse_counted);

BvhHit Bvh::closest(const Ray& ray, double t_max) const {
  BvhHit best;
  best.t = t_max;
  for (const ChartTree& chart : charts_)
    HWY_DYNAMIC_DISPATCH(traverse_closest)({space_, &triangles_, &chart, &ray, height_, &best, nullptr, 1});
  intersect_uncharted(ray, best);
  return best;
}

void Bvh::closest_many(const Ray* rays, BvhHit* hits, std::size_t count) const {
  for (const ChartTree& chart : charts_)
    HWY_DYNAMIC_DISPATCH(traverse_closest)({space_, &triangles_, &chart, rays, height_, hits, nullptr, count});
  for (std::size_t i = 0; i < count && !uncharted_.empty(); ++i) intersect_uncharted(rays[i], hits[i]);
}

BvhHit Bvh::closest_counted(const Ray& ray, double t_max, BvhCounts& counts) const {
  BvhHit best;
  best.t = t_max;
  for (const ChartTree& chart : charts_)
    HWY_DYNAMIC_DISPATCH(traverse_counted)({space_, &triangles_, &chart, &ray, height_, &best, &counts, 1});
  intersect_uncharted(ray, best);
  return best;
}

bool Bvh::occluded(const Ray& ray, double t_max) const {
  BvhHit best;
  best.t = t_max;
  for (const ChartTree& chart : charts_)
    if (HWY_DYNAMIC_DISPATCH(traverse_any)({space_, &triangles_, &chart, &ray, height_, &best, nullptr, 1})) return true;
  intersect_uncharted(ray, best);
  return best.triangle != kNoTriangle;
}

void Bvh::intersect_uncharted(const Ray& ray, BvhHit& best) const {
  if (uncharted_.empty()) return;
  const RayPlane plane = plane_of(space_, ray);
  for (const std::uint32_t triangle : uncharted_) {
    const auto& v = triangles_.corners[triangle];
    const TriangleHit hit = intersect(plane, triangles_.vertices[v[0]], triangles_.vertices[v[1]], triangles_.vertices[v[2]], best.t);
    if (hit.found) best = {triangle, hit.t, {hit.b[0], hit.b[1], hit.b[2]}};
  }
}

}  // namespace orbc::trace
#endif
