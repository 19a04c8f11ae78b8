// A packet is a group of rays of a stream with similar directions. The boxes that any of its rays may intersect are found once, and every
// ray starts there instead of at the root: a camera ray then visits two to four nodes instead of six to eight. This is frustum culling
// (Reshetov, Soupikov, Hurley, Multi-level ray tracing, 2005: entry points of a beam) with the frustum of spirals. In the chart, with p
// along a common direction and q across, a ray is the straight line q(p) at the height z(p) = (f_offset + m·atanκ(α + βp))/c. Then
//  - the largest (smallest) q of the rays is a convex (concave) function of p, so it lies below (above) its chord from the first to the
//  last p;
//  - every z(p) is monotone, so over an interval of p the rays' heights lie between the smallest and the largest at its ends;
//  - between knots z(p) deviates from its chord by at most h²/8·max|z″|, and so do the smallest and the largest of the rays.
// The frustum contains every box that one of its rays may intersect, so rays have the same hits alone and in a packet. Included once per
// instruction set, hence the guard.
#if defined(ORBC_TRACE_PACKET_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ORBC_TRACE_PACKET_INL_H
#undef ORBC_TRACE_PACKET_INL_H
#else
#define ORBC_TRACE_PACKET_INL_H
#endif

#include <hwy/highway.h>

#include "compiler/trace/bvh/chart_ray.h"
#include "compiler/trace/bvh/classify-inl.h"

HWY_BEFORE_NAMESPACE();
namespace orbc::trace::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

inline constexpr int kFrustumKnots = 8;
inline constexpr std::size_t kMaxPacketRays = 64;

/// Bounds of all rays of a packet in one chart.
struct alignas(32) PacketFrustum {
  float ux = 1, uy = 0;       ///< unit vector along p
  float first = 0, last = 0;  ///< interval of p
  float side[2][3] = {};      ///< a point lies outside when side[i]·(x, y, 1) > 0
  /// Padded bounds of the heights at equidistant knots of p, and their differences to the next knot.
  float low[kFrustumKnots], high[kFrustumKnots], low_step[kFrustumKnots], high_step[kFrustumKnots];
  float by_width = 0;  ///< 1 / distance of two knots
};

/// Makes: false when the directions differ too much, or are too steep, for a packet to pay.
template <Space kSpace>
HWY_INLINE bool make_packet_frustum(const ChartTree& chart, const ChartRay* rays, std::size_t count, PacketFrustum& frustum) {
  constexpr float kMinCosine = 0.9f, kMinHorizontal = 0.2f;
  const D d;
  const ChartRay* reference = rays + count / 2;
  while (reference != rays && reference->misses) --reference;
  const float ux = reference->h_y, uy = -reference->h_x, extent = 1.0001f * chart.extent;
  frustum.ux = ux;
  frustum.uy = uy;
  // Per ray: q(p) = q_0 + p·q_1, t(p) = t_0 + p·t_1.
  float q_0[kMaxPacketRays], q_1[kMaxPacketRays], t_0[kMaxPacketRays], t_1[kMaxPacketRays], high_0[kMaxPacketRays], high_1[kMaxPacketRays];
  std::size_t n = 0;
  float first = extent, last = -extent, bend = 0, highest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const ChartRay& ray = rays[i];
    if (ray.misses) continue;
    const float e_p = ray.h_y * ux - ray.h_x * uy, e_q = -ray.h_y * uy - ray.h_x * ux;  // components of its direction (h_y, −h_x)
    if (!(e_p > kMinCosine) || !(ray.z_weight > kMinHorizontal)) return false;
    const float by_p = 1 / e_p, by_c = 1 / ray.z_weight;
    q_0[n] = ray.h_0 * by_p;
    q_1[n] = e_q * by_p;
    t_0[n] = ray.t_per_length * ray.h_0 * e_q * by_p;
    t_1[n] = ray.t_per_length * by_p;
    high_0[n] = ray.f_offset * by_c;
    high_1[n] = ray.s_weight * by_c;
    highest = std::max(highest, std::fabs(high_0[n]));
    bend = std::max(bend, std::fabs(high_1[n]) * t_1[n] * t_1[n]);
    const float by_t = e_p / ray.t_per_length, foot = -ray.h_0 * e_q;
    first = std::min(first, foot + ray.t_start * by_t);
    last = std::max(last, foot + ray.t_end * by_t);
    ++n;
  }
  const float pad = 1e-5f * extent;
  frustum.first = std::max(first, -extent) - pad;
  frustum.last = std::min(last, extent) + pad;
  if (n == 0 || !(frustum.first < frustum.last)) return false;
  const float width = (frustum.last - frustum.first) / (kFrustumKnots - 1);
  frustum.by_width = 1 / width;
  float ends[2][2] = {{kEmptyBound, kEmptyBound}, {-kEmptyBound, -kEmptyBound}};  // smallest and largest q at the first and the last p
  for (std::size_t i = 0; i < n; ++i)
    for (int end = 0; end < 2; ++end) {
      const float q = q_0[i] + q_1[i] * (end ? frustum.last : frustum.first);
      ends[0][end] = std::min(ends[0][end], q);
      ends[1][end] = std::max(ends[1][end], q);
    }
  for (int i = 0; i < 2; ++i) {
    const float sign = i ? 1.0f : -1.0f, slope = (ends[i][1] - ends[i][0]) / (frustum.last - frustum.first);
    frustum.side[i][0] = sign * (-uy - slope * ux);
    frustum.side[i][1] = sign * (ux - slope * uy);
    frustum.side[i][2] =
        -sign * (ends[i][0] - slope * frustum.first) - pad - 2e-6f * std::max(std::fabs(ends[i][0]), std::fabs(ends[i][1]));
  }
  // Heights. Beyond the chart's radius, where there are no triangles, the arc continues as its tangent, so that z″ is bounded.
  const float tangent = static_cast<float>(chart.tan_radius);
  alignas(32) float knot_p[kFrustumKnots];
  for (int k = 0; k < kFrustumKnots; ++k) knot_p[k] = frustum.first + static_cast<float>(k) * width;
  for (std::size_t lane = 0; lane < kFrustumKnots; lane += hn::Lanes(d)) {
    const V p = hn::Load(d, knot_p + lane), max_t = hn::Set(d, tangent), min_t = hn::Set(d, -tangent);
    V low = hn::Set(d, kEmptyBound), high = hn::Set(d, -kEmptyBound);
    for (std::size_t i = 0; i < n; ++i) {
      const V t = hn::MulAdd(p, hn::Set(d, t_1[i]), hn::Set(d, t_0[i]));
      V s = t;
      if constexpr (kSpace != Space::euclidean) {
        const V inside = hn::Min(max_t, hn::Max(min_t, t));
        s = hn::MulAdd(hn::Sub(t, inside), hn::Set(d, chart.arc_slope_at_end), arc<kSpace>(chart, inside));
      }
      const V z = hn::MulAdd(s, hn::Set(d, high_1[i]), hn::Set(d, high_0[i]));
      low = hn::Min(low, z);
      high = hn::Max(high, z);
    }
    hn::Store(low, d, frustum.low + lane);
    hn::Store(high, d, frustum.high + lane);
  }
  for (int k = 0; k < kFrustumKnots; ++k) highest = std::max({highest, std::fabs(frustum.low[k]), std::fabs(frustum.high[k])});
  float margin = pad + 4e-6f * highest;  // far more than any rounding error
  if constexpr (kSpace != Space::euclidean) margin += 0.126f * width * width * bend * chart.max_arc_curvature + 6 * chart.arc_error;
  for (int k = 0; k < kFrustumKnots; ++k) {
    frustum.low[k] -= margin;
    frustum.high[k] += margin;
  }
  for (int k = 0; k < kFrustumKnots; ++k) {
    const int next = std::min(k + 1, kFrustumKnots - 1);
    frustum.low_step[k] = frustum.low[next] - frustum.low[k];
    frustum.high_step[k] = frustum.high[next] - frustum.high[k];
  }
  return true;
}

/// Bit per child of the node whose box a ray of the packet may intersect.
HWY_INLINE std::uint32_t packet_children(const Node8& node, const PacketFrustum& frustum) {
  const D d;
  const hn::RebindToSigned<D> di;
  const V ux = hn::Set(d, frustum.ux), uy = hn::Set(d, frustum.uy), first = hn::Set(d, frustum.first), last = hn::Set(d, frustum.last);
  const auto bound = [&](int axis, bool upper) { return hn::Load(d, node.bounds[axis][upper]); };
  const auto least = [&](V a, float fa, V b, float fb) { return hn::MulAdd(bound(0, fa < 0), a, hn::Mul(bound(1, fb < 0), b)); };
  V from = least(ux, frustum.ux, uy, frustum.uy), to = hn::MulAdd(bound(0, frustum.ux >= 0), ux, hn::Mul(bound(1, frustum.uy >= 0), uy));
  M inside = hn::And(hn::Ge(to, first), hn::Le(from, last));
  for (const auto& side : frustum.side) {
    const V across = least(hn::Set(d, side[0]), side[0], hn::Set(d, side[1]), side[1]);
    inside = hn::And(inside, hn::Le(across, hn::Set(d, -side[2])));
  }
  V low = hn::Set(d, kEmptyBound), high = hn::Set(d, -kEmptyBound);
  for (const V end : {hn::Max(from, first), hn::Min(to, last)}) {
    const V knots =
        hn::Min(hn::Set(d, kFrustumKnots - 1.0f), hn::Max(hn::Zero(d), hn::Mul(hn::Sub(end, first), hn::Set(d, frustum.by_width))));
    const auto knot = hn::ConvertTo(di, knots);
    const V rest = hn::Sub(knots, hn::ConvertTo(d, knot));
    const auto index = hn::IndicesFromVec(d, knot);
    const auto look_up = [&](const float* of) { return hn::TableLookupLanes(hn::Load(d, of), index); };
    low = hn::Min(low, hn::MulAdd(rest, look_up(frustum.low_step), look_up(frustum.low)));
    high = hn::Max(high, hn::MulAdd(rest, look_up(frustum.high_step), look_up(frustum.high)));
  }
  inside = hn::And(inside, hn::And(hn::Le(bound(2, false), high), hn::Ge(bound(2, true), low)));
  return bits_of(inside);
}

/// The node at which the rays of a packet enter the tree: its root, a node made for the packet, or none because they hit nothing.
enum class PacketEntry { root, own_node, none };

/// Finds the node at which a packet enters the tree.
/// Makes: in `root`, if the result is own_node, up to eight boxes deep in the tree that contain all that the packet may hit.
template <Space kSpace>
HWY_NOINLINE PacketEntry find_packet_entry(const ChartTree& chart, const ChartRay* rays, std::size_t ray_count, Node8& root) {
  PacketFrustum frustum;
  if (hn::Lanes(D()) != 8 || !make_packet_frustum<kSpace>(chart, rays, ray_count, frustum)) return PacketEntry::root;
  struct OpenChild {
    std::uint32_t node, lane;
  };
  OpenChild open[8];
  int count = 0;
  for (std::uint32_t bits = packet_children(chart.nodes[0], frustum); bits; bits &= bits - 1)
    open[count++] = {0, static_cast<std::uint32_t>(lowest_bit(bits))};
  for (int i = 0; i < count;) {
    const std::uint32_t child = chart.nodes[open[i].node].child[open[i].lane];
    if (child & kBlockFlag) {
      ++i;
      continue;
    }
    std::uint32_t bits = packet_children(chart.nodes[child], frustum);
    if (count - 1 + static_cast<int>(hwy::PopCount(bits)) > 8) {
      ++i;
      continue;
    }
    open[i] = open[--count];  // its children go to the end, so that the tree opens breadth first
    for (; bits; bits &= bits - 1) open[count++] = {child, static_cast<std::uint32_t>(lowest_bit(bits))};
  }
  if (count == 0) return PacketEntry::none;
  for (auto& axis : root.bounds)
    for (int lane = count; lane < 8; ++lane) {
      axis[0][lane] = kEmptyBound;
      axis[1][lane] = -kEmptyBound;
    }
  for (int lane = 0; lane < count; ++lane) {
    const Node8& from = chart.nodes[open[lane].node];
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 2; ++b) root.bounds[a][b][lane] = from.bounds[a][b][open[lane].lane];
    root.child[lane] = from.child[open[lane].lane];
  }
  return PacketEntry::own_node;
}

}  // namespace orbc::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
