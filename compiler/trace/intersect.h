#pragma once
#include "compiler/trace/ray.h"

namespace orbc::trace {

/// A corner of a geodesic triangle: its floor point and its height, one half of a cache line.
struct alignas(32) Vertex {
  double w = 1, x = 0, y = 0, z = 0;
};

/// Where a ray meets a triangle: path length and barycentric coordinates (affine, sum 1).
struct TriangleHit {
  bool found = false;
  double t = 0;
  double b[3] = {0, 0, 0};
};

/// The part of an intersection that depends on the ray alone: the plane of ambient space that contains its geodesic.
/// Formula: X on the geodesic is p·P + v·V, where p and v are the κ-inner products with P and V; its arc length is s = atanκ(v/p).
struct RayPlane {
  geometry::Space space = geometry::Space::euclidean;
  geometry::Ambient side;      ///< covector: sinκ of the signed distance of X from the geodesic, positive to its left
  geometry::Ambient forward;   ///< covector of p
  geometry::Ambient sideward;  ///< covector of v
  double z = 0, c = 1, m = 0, t_min = 0;
};
[[nodiscard]] inline RayPlane plane_of(geometry::Space space, const Ray& ray) {
  const auto& p = ray.at;
  const auto& v = ray.along;
  const double k = geometry::curvature(space);
  RayPlane plane;
  plane.space = space;
  plane.side = {p.x * v.y - p.y * v.x, p.y * v.w - p.w * v.y, p.w * v.x - p.x * v.w};
  plane.forward = {p.w, k * p.x, k * p.y};
  plane.sideward = {space == geometry::Space::euclidean ? -(p.x * v.x + p.y * v.y) : k * v.w, v.x, v.y};
  plane.z = ray.z;
  plane.c = ray.c;
  plane.m = ray.m;
  plane.t_min = ray.t_min;
  return plane;
}

/// The first point with t_min < t < t_max where the ray meets the geodesic triangle (design §2), in double precision. This is the
/// reference. The BVH decides every hit with it, and therefore finds exactly what testing all triangles finds. Formula: the ray's plane
/// cuts two edges at X₀, X₁ (affine b, linear). Along u ∈ [0, 1] from X₀ to X₁ the height z(u) is linear and the
///          arc is s(u) = atanκ(v(u)/p(u)), v and p linear. The distance of (s, z) from the ray's straight line is
///          G(u) = c·(z_ray − z(u)) + m·s(u), and the path length at its foot t = c·s + m·(z − z_ray). G′ has the sign of a quadratic in u,
///          so [0, 1] falls into at most three monotone pieces; E²: G is linear, closed form. No special case for vertical rays (c = 0).
/// Exact:   a shared edge gives the same bits in both triangles, so both make the same decision there and no ray passes between them.
/// Error:   |G| ≤ 1e-13 · (1 + t) at the returned t (tests); it is the distance between the ray and the surface point at b.
/// Not promised: hits of triangles whose plane contains the ray.
[[nodiscard]] TriangleHit intersect(const RayPlane& plane, const Vertex& a, const Vertex& b, const Vertex& c, double t_max = kInfinity);

}  // namespace orbc::trace
