// A ray through the tree: the SIMD kernels, compiled once per instruction set by Highway and chosen at run time for a whole call.
// Float decides only what surely misses and what is surely met once; everything else is put to `intersect` in double (see bvh.h).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compiler/trace/bvh_traverse.cpp"
// AVX-512 was measured to gain nothing here (a node has eight children). SSSE3 without SSE4 is a processor of 2006:
// it takes the SSE2 kernel.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3 | HWY_AVX3_DL)
#include <hwy/foreach_target.h>
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "compiler/trace/chart_ray.h"
#include "compiler/trace/fan-inl.h"
#include "compiler/trace/judge-inl.h"
#include "compiler/trace/meet.h"
#include "compiler/trace/resolve-inl.h"
#include "compiler/trace/set_up-inl.h"
#include "compiler/trace/walk.h"

HWY_BEFORE_NAMESPACE();
namespace orbc::trace::HWY_NAMESPACE {

/// t of the point b of a triangle of the block: where the search may now end.
HWY_INLINE float t_of(const Block8& block, int lane, const ChartRay& ray, const BvhHit& hit) {
  float sum = 0, weights = 0;
  for (int i = 0; i < 3; ++i) {
    const float weight = static_cast<float>(hit.b[i]) / block.by_w[i][lane];
    sum += weight * (ray.t_x * block.x[i][lane] + ray.t_y * block.y[i][lane]);
    weights += weight;
  }
  const float t = sum / weights;
  return t + 2 * ray.t_error + 4e-6f * std::fabs(t);
}

/// A child on the stack, nearest first when compared as a number: where the ray enters it (as an integer of the same order) and which it
/// is.
using Entry = std::uint64_t;

HWY_INLINE std::uint32_t order_of(float t) {
  std::uint32_t bits;
  std::memcpy(&bits, &t, 4);
  return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

HWY_INLINE void sort(Entry& a, Entry& b) {  // the nearer one to b: on top
  const Entry near = a < b ? a : b;
  a = a < b ? b : a;
  b = near;
}

/// The next node or block, and the others on the stack.
struct Way {
  std::uint32_t child = 0;
  Entry* top = nullptr;
};

/// What only rays need that end in double; made once for many.
struct InDouble {
  RayPlane plane;
  BvhHit before;                    ///< the best before anything was tried in double
};

/// The walk of one ray through one tree. What it finds does not depend on the order in which nodes and blocks come, nor on where it starts:
/// rays meet the same, bit by bit, alone and in a fan.
template <Space kSpace, int kTerms, bool kAny, bool kCount>
struct Walker {
  ChartRay& ray;
  const Ray& source;
  BvhHit& best;
  /// Surely met: in double only when the walk is over, or to compare when another triangle comes too near
  Pending& pending;
  InDouble& in_double;
  Entry* const stack;
  bool exact = false, found = false;

  HWY_INLINE bool pop(Way& way) const {
    const std::uint32_t end = order_of(ray.reach);
    while (way.top != stack) {
      const Entry entry = *--way.top;
      if (static_cast<std::uint32_t>(entry >> 32) > end) continue;
      way.child = static_cast<std::uint32_t>(entry);
      return true;
    }
    return false;
  }

  /// Goes on to the nearest child, the others to the stack, the nearer on top. False: nothing is touched.
  HWY_INLINE bool visit_node(const Walk& walk, const Node8& node, Way& way) {
    if constexpr (kCount) ++walk.counts->nodes;
    alignas(32) float enters[8];
    std::uint32_t bits = touched<kTerms>(node, *walk.chart, ray, ray.reach, enters);
    if (bits == 0) return false;
    const int first = lowest_bit(bits);
    bits &= bits - 1;
    way.child = node.child[first];
    if (bits == 0) return true;
    const auto entry = [&](int lane) { return static_cast<Entry>(order_of(enters[lane])) << 32 | node.child[lane]; };
    Entry a = entry(first), b = entry(lowest_bit(bits));
    bits &= bits - 1;
    sort(a, b);
    way.child = static_cast<std::uint32_t>(b);
    *way.top++ = a;
    if (bits == 0) return true;
    Entry* const base = way.top - 1;
    *way.top++ = b;
    do {  // insertion: rarely more than one or two are left
      Entry other = entry(lowest_bit(bits));
      bits &= bits - 1;
      Entry* at = way.top++;
      for (; at > base && at[-1] < other; --at) *at = at[-1];
      *at = other;
    } while (bits);
    way.child = static_cast<std::uint32_t>(*--way.top);
    return true;
  }

  /// In double. Makes: whether it is met before the best so far; of two at the same t the first in the soup.
  /// In: whether it is surely met and far from the ray's ends (`pends`): then the last word on its point is resolve_many's.
  HWY_INLINE bool meet(const Walk& walk, const Pending& triangle, bool sure, bool pends) {
    const auto& v = walk.soup->triangles[triangle.triangle];
    const Vertex* vertices = walk.soup->vertices.data();
    const Vertex* const corners[3] = {vertices + v[0], vertices + v[1], vertices + v[2]};
    const double end = found ? std::nextafter(best.t, kEndless) : best.t;
    const TriangleHit hit = sure && kSpace != Space::euclidean
                                ? trace::exact::meet_once<kSpace>(in_double.plane, corners, end, triangle.guess)
                                : trace::exact::meet<kSpace>(in_double.plane, corners, end);
    if (!hit.found || (found && hit.t == best.t && triangle.triangle > best.triangle)) return false;
    best = {triangle.triangle, hit.t, {hit.b[0], hit.b[1], hit.b[2]}};
    pending = triangle;
    if (!pends) pending.triangle = kNone;
    return found = true;
  }

  /// From here on all is tried in double.
  HWY_INLINE void begin_exact(const Walk& walk) {
    if (exact) return;
    exact = true;
    in_double = {plane_of(kSpace, source), best};
    if (pending.triangle != kNone) meet(walk, Pending(pending), true, true);
  }

  /// If the nearest triangle is still without its point, `best` is as it was before.
  HWY_INLINE void end() {
    if (exact && pending.triangle != kNone) best = in_double.before;
  }

  /// False: any hit was wanted and is found.
  HWY_INLINE bool visit_block(const Walk& walk, std::uint32_t child) {
    const Block8& block = walk.chart->blocks[child & ~kBlock];
    if constexpr (kCount) ++walk.counts->blocks;
    Verdict verdict;
    judge<kSpace>(block, *walk.chart, ray, verdict);
    for (std::uint32_t bits = verdict.candidates; bits; bits &= bits - 1) {
      const int lane = lowest_bit(bits);
      const std::uint32_t triangle = block.triangle[lane];
      if (triangle == kNone) continue;
      if constexpr (kCount) ++walk.counts->candidates;
      const bool sure = verdict.sure >> lane & 1;
      const float near = verdict.nearer[lane], far = verdict.farther[lane], f = verdict.f_one[lane];
      const float guess = f / (f - verdict.f_two[lane]);
      const bool pends = sure && near > ray.surely_after && far < ray.surely_before;
      if (pends && !exact) {
        if constexpr (kAny) {
          found = true;
          return false;
        }
        if (pending.triangle != kNone && near > pending.farther) continue;
        if (pending.triangle == kNone || far < pending.nearer) {
          pending = {triangle, guess, near, far};
          hwy::Prefetch(&walk.soup->triangles[triangle]);  // of nodes and blocks it was measured to cost more than it saves
          ray.reach = std::min(ray.reach, far);
          continue;
        }
      }
      begin_exact(walk);  // two triangles too near to each other, or an end of the ray too near
      if (!meet(walk, {triangle, guess, near, far}, sure, pends)) continue;
      if constexpr (kAny) return false;
      ray.reach = std::min(ray.reach, sure ? far : t_of(block, lane, ray, best));
    }
    return true;
  }
};

/// Many rays: set up eight at a time, started where all of a fan may touch something, resolved four at a time. A single ray goes the same
/// way, so that it gives the same bits alone and in a stream. In: kMost at a time.
template <Space kSpace, int kTerms, bool kAny, bool kCount, std::size_t kMost>
bool walk_all(const Walk& walk) {
  constexpr std::size_t kFewest = 8;  // for which a fan is worth it
  ChartRay rays[kMost];
  Pending pending[kMost];
  InDouble in_double;
  Entry stack[8 * kDeepest];
  for (std::size_t first = 0; first < walk.count; first += kMost) {
    const std::size_t count = std::min(kMost, walk.count - first);
    for (std::size_t i = 0; i < count; i += 8) set_up<kSpace>(walk, first + i, std::min<std::size_t>(8, count - i), rays + i);
    Node8 shared;
    const Node8* root = walk.chart->nodes.data();
    if (count >= kFewest) {
      const FanRoot found = find_root<kSpace>(*walk.chart, rays, count, shared);
      if (found == FanRoot::nothing) continue;
      if (found == FanRoot::own) root = &shared;
    }
    for (std::size_t i = 0; i < count; ++i) {
      pending[i].triangle = kNone;
      if (rays[i].misses) continue;
      Walker<kSpace, kTerms, kAny, kCount> walker{rays[i], walk.ray[first + i], walk.best[first + i], pending[i], in_double, stack};
      Way way{0, walker.stack};
      bool touches = walker.visit_node(walk, *root, way);
      do {
        while (touches && !(way.child & kBlock)) touches = walker.visit_node(walk, walk.chart->nodes[way.child], way);
        if (touches && !walker.visit_block(walk, way.child)) return true;
        touches = true;
      } while (walker.pop(way));
      walker.end();
    }
    if constexpr (!kAny) resolve_many<kSpace>(walk, first, count, pending);
  }
  return false;
}

template <Space kSpace, int kTerms, bool kAny, bool kCount>
bool walk_with(const Walk& walk) {
  if constexpr (!kAny && !kCount) {
    if (walk.count > 1) return walk_all<kSpace, kTerms, kAny, kCount, kFan>(walk);
  }
  return walk_all<kSpace, kTerms, kAny, kCount, 1>(walk);
}

template <bool kAny, bool kCount>
bool walk_chart(const Walk& walk) {
  const int terms = walk.chart->terms;
  if (walk.space == Space::euclidean) return walk_with<Space::euclidean, 1, kAny, kCount>(walk);
  if (walk.space == Space::spherical)
    return terms == 2   ? walk_with<Space::spherical, 2, kAny, kCount>(walk)
           : terms == 4 ? walk_with<Space::spherical, 4, kAny, kCount>(walk)
                        : walk_with<Space::spherical, 7, kAny, kCount>(walk);
  return terms == 3   ? walk_with<Space::hyperbolic, 3, kAny, kCount>(walk)
         : terms == 5 ? walk_with<Space::hyperbolic, 5, kAny, kCount>(walk)
                      : walk_with<Space::hyperbolic, 7, kAny, kCount>(walk);
}

bool walk_closest(const Walk& walk) { return walk_chart<false, false>(walk); }
bool walk_any(const Walk& walk) { return walk_chart<true, false>(walk); }
bool walk_counted(const Walk& walk) { return walk_chart<false, true>(walk); }

}  // namespace orbc::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace orbc::trace {

HWY_EXPORT(walk_closest);
HWY_EXPORT(walk_any);
HWY_EXPORT(walk_counted);

BvhHit Bvh::closest(const Ray& ray, double t_max) const {
  BvhHit best;
  best.t = t_max;
  for (const Chart& chart : charts_) HWY_DYNAMIC_DISPATCH(walk_closest)({space_, &soup_, &chart, &ray, height_, &best, nullptr, 1});
  try_large(ray, best);
  return best;
}

void Bvh::closest_many(const Ray* rays, BvhHit* hits, std::size_t count) const {
  for (const Chart& chart : charts_) HWY_DYNAMIC_DISPATCH(walk_closest)({space_, &soup_, &chart, rays, height_, hits, nullptr, count});
  for (std::size_t i = 0; i < count && !large_.empty(); ++i) try_large(rays[i], hits[i]);
}

BvhHit Bvh::closest_counted(const Ray& ray, double t_max, BvhCounts& counts) const {
  BvhHit best;
  best.t = t_max;
  for (const Chart& chart : charts_) HWY_DYNAMIC_DISPATCH(walk_counted)({space_, &soup_, &chart, &ray, height_, &best, &counts, 1});
  try_large(ray, best);
  return best;
}

bool Bvh::occluded(const Ray& ray, double t_max) const {
  BvhHit best;
  best.t = t_max;
  for (const Chart& chart : charts_)
    if (HWY_DYNAMIC_DISPATCH(walk_any)({space_, &soup_, &chart, &ray, height_, &best, nullptr, 1})) return true;
  try_large(ray, best);
  return best.triangle != kNone;
}

void Bvh::try_large(const Ray& ray, BvhHit& best) const {
  if (large_.empty()) return;
  const RayPlane plane = plane_of(space_, ray);
  for (const std::uint32_t triangle : large_) {
    const auto& v = soup_.triangles[triangle];
    const TriangleHit hit = intersect(plane, soup_.vertices[v[0]], soup_.vertices[v[1]], soup_.vertices[v[2]], best.t);
    if (hit.found) best = {triangle, hit.t, {hit.b[0], hit.b[1], hit.b[2]}};
  }
}

}  // namespace orbc::trace
#endif
