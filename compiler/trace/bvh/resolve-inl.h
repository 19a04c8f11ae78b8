// Computes the hit points of triangles that are certainly hit once, four at a time in double: `exact::refine_hit` with SIMD. Included once
// per instruction set, hence the guard.
#if defined(ORBC_TRACE_RESOLVE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ORBC_TRACE_RESOLVE_INL_H
#undef ORBC_TRACE_RESOLVE_INL_H
#else
#define ORBC_TRACE_RESOLVE_INL_H
#endif

#include <hwy/highway.h>

#include "compiler/trace/bvh/traversal.h"
#include "compiler/trace/bvh/unfused-inl.h"
#include "compiler/trace/intersect_exact.h"

HWY_BEFORE_NAMESPACE();
namespace orbc::trace::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D4 = hn::CappedTag<double, 4>;
using V4 = hn::Vec<D4>;

struct Triple {
  V4 w, x, y;
};
HWY_INLINE V4 dot(const Triple& a, const Triple& b) { return mul_add(a.w, b.w, mul_add(a.x, b.x, hn::Mul(a.y, b.y))); }

/// Inputs and results of four hits, as a structure of arrays.
struct alignas(64) Quad {
  double ray[9][4];        ///< P, V, z, c, m
  double corner[3][4][4];  ///< per corner w, x, y, z
  double guess[4];
  double t[4], b1[4], b2[4], g[4], u[4];  ///< results
};

template <geometry::Space kSpace>
HWY_INLINE V4 arc4(V4 p, V4 v) {
  const D4 d;
  if constexpr (kSpace == geometry::Space::euclidean) return hn::Div(v, p);
  if constexpr (kSpace == geometry::Space::hyperbolic) return hn::Mul(hn::Set(d, 0.5), log_of(d, hn::Div(hn::Add(p, v), hn::Sub(p, v))));
  return arc_around(d, v, p);
}

template <geometry::Space kSpace>
HWY_INLINE void resolve_four(Quad& q) {
  const D4 d;
  constexpr double k = geometry::curvature(kSpace);
  for (std::size_t i = 0; i < 4; i += hn::Lanes(d)) {
    const auto load = [&](const double* from) { return hn::Load(d, from + i); };
    const Triple p{load(q.ray[0]), load(q.ray[1]), load(q.ray[2])}, v{load(q.ray[3]), load(q.ray[4]), load(q.ray[5])};
    const V4 z_ray = load(q.ray[6]), c = load(q.ray[7]), m = load(q.ray[8]), kappa = hn::Set(d, k);
    const Triple side{mul_sub(p.x, v.y, hn::Mul(p.y, v.x)), mul_sub(p.y, v.w, hn::Mul(p.w, v.y)), mul_sub(p.w, v.x, hn::Mul(p.x, v.w))};
    const Triple forward{p.w, hn::Mul(kappa, p.x), hn::Mul(kappa, p.y)};
    const Triple sideward{kSpace == geometry::Space::euclidean ? hn::Neg(mul_add(p.x, v.x, hn::Mul(p.y, v.y))) : hn::Mul(kappa, v.w), v.x,
                          v.y};
    V4 h[3], pp[3], vv[3], z[3];
    for (int j = 0; j < 3; ++j) {
      const Triple x{load(q.corner[j][0]), load(q.corner[j][1]), load(q.corner[j][2])};
      h[j] = dot(side, x);
      pp[j] = dot(forward, x);
      vv[j] = dot(sideward, x);
      z[j] = load(q.corner[j][3]);
    }
    // The two cut edges: (0 or 2, 1) and (0 or 1, 2).
    const V4 zero = hn::Zero(d), one = hn::Set(d, 1.0);
    const auto left0 = hn::Ge(h[0], zero), left1 = hn::Ge(h[1], zero), left2 = hn::Ge(h[2], zero);
    const auto to1 = hn::Xor(left0, left1), to2 = hn::Xor(left0, left2);
    const auto select = [&](auto mask, const V4* of, int other) { return hn::IfThenElse(mask, of[0], of[other]); };
    const V4 ha = hn::Abs(select(to1, h, 2)), hb = hn::Abs(select(to2, h, 1)), h1 = hn::Abs(h[1]), h2 = hn::Abs(h[2]);
    const V4 wa = hn::Div(ha, hn::Add(ha, h1)), wb = hn::Div(hb, hn::Add(hb, h2));  // weights of corners 1 and 2
    const auto mix = [&](V4 from, V4 to, V4 w) { return mul_add(w, hn::Sub(to, from), from); };
    const V4 pa = mix(select(to1, pp, 2), pp[1], wa), va = mix(select(to1, vv, 2), vv[1], wa), za = mix(select(to1, z, 2), z[1], wa);
    const V4 dp = hn::Sub(mix(select(to2, pp, 1), pp[2], wb), pa), dv = hn::Sub(mix(select(to2, vv, 1), vv[2], wb), va);
    const V4 dz = hn::Sub(mix(select(to2, z, 1), z[2], wb), za);
    const V4 twist = mul_sub(pa, dv, hn::Mul(va, dp));
    V4 u = load(q.guess), pu = mul_add(u, dp, pa), vu = mul_add(u, dv, va), s = arc4<kSpace>(pu, vu);
    const auto value = [&] { return mul_add(c, hn::Sub(z_ray, mul_add(u, dz, za)), hn::Mul(m, s)); };
    const V4 speed = hn::Div(twist, mul_add(pu, pu, hn::Mul(kappa, hn::Mul(vu, vu))));
    const V4 by_slope = hn::Div(one, mul_sub(m, speed, hn::Mul(c, dz)));
    V4 g = value();
    for (int step = 0; step < (kSpace == geometry::Space::euclidean ? 1 : 2); ++step) {  // E²: linear
      const V4 du = hn::Neg(hn::Mul(g, by_slope)), p_old = pu, v_old = vu;
      u = hn::Add(u, du);
      pu = mul_add(u, dp, pa);
      vu = mul_add(u, dv, va);
      const V4 x = hn::Div(hn::Mul(du, twist), mul_add(p_old, pu, hn::Mul(kappa, hn::Mul(v_old, vu))));
      s = hn::Add(s, neg_mul_add(hn::Mul(hn::Set(d, k / 3), x), hn::Mul(x, x), x));
      g = value();
    }
    const V4 rest = hn::Sub(one, u);
    // Weights of the corners 1 and 2: from the edge that ends there, and from the other edge if it ends there too.
    const V4 b1 = mul_add(rest, wa, hn::IfThenElseZero(hn::Not(to2), hn::Mul(u, hn::Sub(one, wb))));
    const V4 b2 = mul_add(u, wb, hn::IfThenElseZero(hn::Not(to1), hn::Mul(rest, hn::Sub(one, wa))));
    hn::Store(mul_add(c, s, hn::Mul(m, hn::Sub(mul_add(u, dz, za), z_ray))), d, q.t + i);
    hn::Store(b1, d, q.b1 + i);
    hn::Store(b2, d, q.b2 + i);
    hn::Store(g, d, q.g + i);
    hn::Store(u, d, q.u + i);
  }
}

/// Computes the deferred hits of `count` rays of the batch, from index `first` on.
template <geometry::Space kSpace>
HWY_NOINLINE void resolve_many(const TraversalBatch& batch, std::size_t first, std::size_t count, const DeferredHit* deferred) {
  Quad quad;
  std::size_t index[4];
  int filled = 0;
  const auto corners_of = [&](std::uint32_t triangle, const Vertex* out[3]) {
    for (int j = 0; j < 3; ++j) out[j] = batch.triangles->vertices.data() + batch.triangles->corners[triangle][j];
  };
  const auto flush = [&] {
    if (filled == 0) return;
    for (int lane = filled; lane < 4; ++lane) {  // unused lanes repeat the first, so that they hold no NaN and no subnormal numbers
      for (auto& field : quad.ray) field[lane] = field[0];
      for (auto& corner : quad.corner)
        for (auto& field : corner) field[lane] = field[0];
      quad.guess[lane] = quad.guess[0];
    }
    resolve_four<kSpace>(quad);
    for (int lane = 0; lane < filled; ++lane) {
      const std::size_t i = index[lane];
      BvhHit& best = batch.best[first + i];
      const Ray& ray = batch.rays[first + i];
      if (std::fabs(quad.g[lane]) <= 2e-15 && quad.u[lane] >= 0 && quad.u[lane] <= 1) {
        if (quad.t[lane] > ray.t_min && quad.t[lane] < best.t)
          best = {deferred[i].triangle, quad.t[lane], {1 - quad.b1[lane] - quad.b2[lane], quad.b1[lane], quad.b2[lane]}};
        continue;
      }
      const Vertex* corners[3];
      corners_of(deferred[i].triangle, corners);
      const TriangleHit hit = exact::intersect_triangle<kSpace>(plane_of(kSpace, ray), corners, best.t);
      if (hit.found) best = {deferred[i].triangle, hit.t, {hit.b[0], hit.b[1], hit.b[2]}};
    }
    filled = 0;
  };
  for (std::size_t i = 0; i < count; ++i) {
    if (deferred[i].triangle == kNoTriangle) continue;
    const Ray& ray = batch.rays[first + i];
    const double fields[9] = {ray.at.w, ray.at.x, ray.at.y, ray.along.w, ray.along.x, ray.along.y, ray.z, ray.c, ray.m};
    for (int f = 0; f < 9; ++f) quad.ray[f][filled] = fields[f];
    const Vertex* corners[3];
    corners_of(deferred[i].triangle, corners);
    for (int j = 0; j < 3; ++j) {
      quad.corner[j][0][filled] = corners[j]->w;
      quad.corner[j][1][filled] = corners[j]->x;
      quad.corner[j][2][filled] = corners[j]->y;
      quad.corner[j][3][filled] = corners[j]->z;
    }
    quad.guess[filled] = deferred[i].guess;
    index[filled++] = i;
    if (filled == 4) flush();
  }
  flush();
}

}  // namespace orbc::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
