// A fan: rays of a stream that go nearly the same way. What all of them may touch is looked for once, and every ray starts there instead of
// at the root: a camera's ray then visits two to four nodes instead of six to eight. Frustum culling is old (Reshetov, Soupikov, Hurley,
// Multi-level ray tracing, 2005: the entry points of a beam); this is the frustum of spirals. In the chart, with p along a common direction
// and q across, a ray is the straight line q(p) at the height z(p) = (level + m·atanκ(α + βp))/c. Then
//  - the largest (smallest) q of the rays is a convex (concave) function of p: it lies below (above) its chord from first to last p;
//  - every z(p) is monotone, so over an interval of p the rays' heights lie between the least and the largest at its ends;
//  - between knots z(p) leaves its chord by at most h²/8·max|z″|, the same for the least and the largest of the rays.
// Nothing that a ray may touch is left out, so rays meet the same alone and in a fan. Included once per instruction set, hence the guard.
#if defined(ORBC_TRACE_FAN_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ORBC_TRACE_FAN_INL_H
#undef ORBC_TRACE_FAN_INL_H
#else
#define ORBC_TRACE_FAN_INL_H
#endif

#include <hwy/highway.h>

#include "compiler/trace/chart_ray.h"
#include "compiler/trace/judge-inl.h"

HWY_BEFORE_NAMESPACE();
namespace orbc::trace::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

inline constexpr int kKnots = 8;
inline constexpr std::size_t kFan = 64;  ///< rays at most

/// What the rays of a fan have in common.
struct alignas(32) Fan {
  float ux = 1, uy = 0;             ///< the direction of p
  float first = 0, last = 0;        ///< of p
  float side[2][3] = {};            ///< a point lies outside when side[i]·(x, y, 1) > 0
  float low[kKnots], high[kKnots], low_step[kKnots], high_step[kKnots];  ///< heights at the knots, padded, and on to the next knot
  float by_width = 0;               ///< of the interval between two knots
};

/// Makes: false when the rays go too differently, or too steeply, to be worth it.
template <Space kSpace>
HWY_INLINE bool make_fan(const Chart& chart, const ChartRay* rays, std::size_t count, Fan& fan) {
  constexpr float kAlike = 0.9f, kLeastRun = 0.2f;
  const D d;
  const ChartRay* model = rays + count / 2;
  while (model != rays && model->misses) --model;
  const float ux = model->h_y, uy = -model->h_x, extent = 1.0001f * chart.extent;
  fan.ux = ux, fan.uy = uy;
  // Per ray: q(p) = q_0 + p·q_1, t(p) = t_0 + p·t_1.
  float q_0[kFan], q_1[kFan], t_0[kFan], t_1[kFan], high_0[kFan], high_1[kFan];
  std::size_t n = 0;
  float first = extent, last = -extent, bend = 0, highest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const ChartRay& ray = rays[i];
    if (ray.misses) continue;
    const float e_p = ray.h_y * ux - ray.h_x * uy, e_q = -ray.h_y * uy - ray.h_x * ux;  // of its direction (h_y, −h_x)
    if (!(e_p > kAlike) || !(ray.rise > kLeastRun)) return false;
    const float by_p = 1 / e_p, by_c = 1 / ray.rise;
    q_0[n] = ray.h_0 * by_p, q_1[n] = e_q * by_p;
    t_0[n] = ray.stretch * ray.h_0 * e_q * by_p, t_1[n] = ray.stretch * by_p;
    high_0[n] = ray.level * by_c, high_1[n] = ray.run * by_c;
    highest = std::max(highest, std::fabs(high_0[n]));
    bend = std::max(bend, std::fabs(high_1[n]) * t_1[n] * t_1[n]);
    const float by_t = e_p / ray.stretch, foot = -ray.h_0 * e_q;
    first = std::min(first, foot + ray.start * by_t);
    last = std::max(last, foot + ray.reach * by_t);
    ++n;
  }
  const float pad = 1e-5f * extent;
  fan.first = std::max(first, -extent) - pad;
  fan.last = std::min(last, extent) + pad;
  if (n == 0 || !(fan.first < fan.last)) return false;
  const float width = (fan.last - fan.first) / (kKnots - 1);
  fan.by_width = 1 / width;
  float ends[2][2] = {{kNever, kNever}, {-kNever, -kNever}};  // least and largest q at the first and the last p
  for (std::size_t i = 0; i < n; ++i)
    for (int end = 0; end < 2; ++end) {
      const float q = q_0[i] + q_1[i] * (end ? fan.last : fan.first);
      ends[0][end] = std::min(ends[0][end], q);
      ends[1][end] = std::max(ends[1][end], q);
    }
  for (int i = 0; i < 2; ++i) {
    const float sign = i ? 1.0f : -1.0f, slope = (ends[i][1] - ends[i][0]) / (fan.last - fan.first);
    fan.side[i][0] = sign * (-uy - slope * ux);
    fan.side[i][1] = sign * (ux - slope * uy);
    fan.side[i][2] = -sign * (ends[i][0] - slope * fan.first) - pad - 2e-6f * std::max(std::fabs(ends[i][0]), std::fabs(ends[i][1]));
  }
  // Heights: beyond the chart's radius, where nothing is, arcs go on as tangents, so that z″ is bounded.
  const float tangent = static_cast<float>(chart.tangent);
  alignas(32) float place[kKnots];
  for (int k = 0; k < kKnots; ++k) place[k] = fan.first + static_cast<float>(k) * width;
  for (std::size_t lane = 0; lane < kKnots; lane += hn::Lanes(d)) {
    const V p = hn::Load(d, place + lane), most = hn::Set(d, tangent), least = hn::Set(d, -tangent);
    V low = hn::Set(d, kNever), high = hn::Set(d, -kNever);
    for (std::size_t i = 0; i < n; ++i) {
      const V t = hn::MulAdd(p, hn::Set(d, t_1[i]), hn::Set(d, t_0[i]));
      V s = t;
      if constexpr (kSpace != Space::euclidean) {
        const V inside = hn::Min(most, hn::Max(least, t));
        s = hn::MulAdd(hn::Sub(t, inside), hn::Set(d, chart.last_slope), arc<kSpace>(chart, inside));
      }
      const V z = hn::MulAdd(s, hn::Set(d, high_1[i]), hn::Set(d, high_0[i]));
      low = hn::Min(low, z);
      high = hn::Max(high, z);
    }
    hn::Store(low, d, fan.low + lane);
    hn::Store(high, d, fan.high + lane);
  }
  for (int k = 0; k < kKnots; ++k) highest = std::max({highest, std::fabs(fan.low[k]), std::fabs(fan.high[k])});
  float off = pad + 4e-6f * highest;  // far more than any rounding
  if constexpr (kSpace != Space::euclidean) off += 0.126f * width * width * bend * chart.sharpest_arc + 6 * chart.arc_error;
  for (int k = 0; k < kKnots; ++k) fan.low[k] -= off, fan.high[k] += off;
  for (int k = 0; k < kKnots; ++k) {
    const int next = std::min(k + 1, kKnots - 1);
    fan.low_step[k] = fan.low[next] - fan.low[k];
    fan.high_step[k] = fan.high[next] - fan.high[k];
  }
  return true;
}

/// Which of a node's boxes a ray of the fan may touch.
HWY_INLINE std::uint32_t touched_by_fan(const Node8& node, const Fan& fan) {
  const D d;
  const hn::RebindToSigned<D> di;
  const V ux = hn::Set(d, fan.ux), uy = hn::Set(d, fan.uy), first = hn::Set(d, fan.first), last = hn::Set(d, fan.last);
  const auto bound = [&](int axis, bool upper) { return hn::Load(d, node.bounds[axis][upper]); };
  const auto least = [&](V a, float fa, V b, float fb) { return hn::MulAdd(bound(0, fa < 0), a, hn::Mul(bound(1, fb < 0), b)); };
  V from = least(ux, fan.ux, uy, fan.uy), to = hn::MulAdd(bound(0, fan.ux >= 0), ux, hn::Mul(bound(1, fan.uy >= 0), uy));
  M inside = hn::And(hn::Ge(to, first), hn::Le(from, last));
  for (const auto& side : fan.side) {
    const V across = least(hn::Set(d, side[0]), side[0], hn::Set(d, side[1]), side[1]);
    inside = hn::And(inside, hn::Le(across, hn::Set(d, -side[2])));
  }
  V low = hn::Set(d, kNever), high = hn::Set(d, -kNever);
  for (const V end : {hn::Max(from, first), hn::Min(to, last)}) {
    const V knots = hn::Min(hn::Set(d, kKnots - 1.0f), hn::Max(hn::Zero(d), hn::Mul(hn::Sub(end, first), hn::Set(d, fan.by_width))));
    const auto knot = hn::ConvertTo(di, knots);
    const V rest = hn::Sub(knots, hn::ConvertTo(d, knot));
    const auto index = hn::IndicesFromVec(d, knot);
    const auto look_up = [&](const float* of) { return hn::TableLookupLanes(hn::Load(d, of), index); };
    low = hn::Min(low, hn::MulAdd(rest, look_up(fan.low_step), look_up(fan.low)));
    high = hn::Max(high, hn::MulAdd(rest, look_up(fan.high_step), look_up(fan.high)));
  }
  inside = hn::And(inside, hn::And(hn::Le(bound(2, false), high), hn::Ge(bound(2, true), low)));
  return bits_of(inside);
}

/// Where the rays of a fan start: at the tree's root, at one of their own, or nowhere: they touch nothing.
enum class FanRoot { tree, own, nothing };

/// Makes: of the boxes that the fan may touch the eight deepest that stand for all.
template <Space kSpace>
HWY_NOINLINE FanRoot find_root(const Chart& chart, const ChartRay* rays, std::size_t count_of_rays, Node8& root) {
  Fan fan;
  if (hn::Lanes(D()) != 8 || !make_fan<kSpace>(chart, rays, count_of_rays, fan)) return FanRoot::tree;
  struct Place {
    std::uint32_t node, lane;
  };
  Place open[8];
  int count = 0;
  for (std::uint32_t bits = touched_by_fan(chart.nodes[0], fan); bits; bits &= bits - 1)
    open[count++] = {0, static_cast<std::uint32_t>(lowest_bit(bits))};
  for (int i = 0; i < count;) {
    const std::uint32_t child = chart.nodes[open[i].node].child[open[i].lane];
    if (child & kBlock) {
      ++i;
      continue;
    }
    std::uint32_t bits = touched_by_fan(chart.nodes[child], fan);
    if (count - 1 + static_cast<int>(hwy::PopCount(bits)) > 8) {
      ++i;
      continue;
    }
    open[i] = open[--count];  // what replaces it comes last: level after level
    for (; bits; bits &= bits - 1) open[count++] = {child, static_cast<std::uint32_t>(lowest_bit(bits))};
  }
  if (count == 0) return FanRoot::nothing;
  for (auto& axis : root.bounds)
    for (int lane = count; lane < 8; ++lane) axis[0][lane] = kNever, axis[1][lane] = -kNever;
  for (int lane = 0; lane < count; ++lane) {
    const Node8& from = chart.nodes[open[lane].node];
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 2; ++b) root.bounds[a][b][lane] = from.bounds[a][b][open[lane].lane];
    root.child[lane] = from.child[open[lane].lane];
  }
  return FanRoot::own;
}

}  // namespace orbc::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
