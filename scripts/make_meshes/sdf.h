#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "compiler/mesh/mesh.h"

// Shapes as distance fields (negative inside): unions of soft bodies, turned into a closed mesh. Formulas of single bodies after
// Inigo Quilez, "distance functions" (iquilezles.org/articles/distfunctions).
namespace make_meshes {

using orbc::geometry::Vector3;
using Field = std::function<double(const Vector3&)>;

inline double mix(double a, double b, double t) { return a + (b - a) * t; }
inline Vector3 mix(const Vector3& a, const Vector3& b, double t) { return a + t * (b - a); }
inline double smoothstep(double a, double b, double x) {
  const double t = std::clamp((x - a) / (b - a), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Union with a fillet of about k.
inline double blend(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * h * k / 6;
}
/// a without b, with a fillet.
inline double carve(double a, double b, double k) { return -blend(-a, b, k); }

inline double ball(const Vector3& p, const Vector3& c, double r) { return length(p - c) - r; }
inline double ellipsoid(const Vector3& p, const Vector3& c, const Vector3& r) {
  const Vector3 q = p - c;
  const Vector3 a{q.x / r.x, q.y / r.y, q.z / r.z}, b{a.x / r.x, a.y / r.y, a.z / r.z};
  const double k0 = length(a), k1 = length(b);
  return k1 > 0 ? k0 * (k0 - 1) / k1 : -std::min({r.x, r.y, r.z});
}
/// From a ball of radius r1 at a to one of radius r2 at b.
inline double cone(const Vector3& p, const Vector3& a, const Vector3& b, double r1, double r2) {
  const Vector3 ba = b - a, pa = p - a;
  const double l2 = dot(ba, ba), rr = r1 - r2, a2 = l2 - rr * rr, il2 = 1 / l2, y = dot(pa, ba), z = y - l2;
  const Vector3 v = l2 * pa - y * ba;
  const double x2 = dot(v, v), y2 = y * y * l2, z2 = z * z * l2, k = (rr > 0 ? 1 : rr < 0 ? -1 : 0) * rr * rr * x2;
  if ((z > 0 ? 1 : -1) * a2 * z2 > k) return std::sqrt(x2 + z2) * il2 - r2;
  if ((y > 0 ? 1 : -1) * a2 * y2 < k) return std::sqrt(x2 + y2) * il2 - r1;
  return (std::sqrt(x2 * a2 * il2) + y * rr) * il2 - r1;
}
/// An upright disc with rounded rim, from z0 to z1.
inline double disc(const Vector3& p, double z0, double z1, double radius, double round) {
  const double dx = std::hypot(p.x, p.y) - radius + round, dz = std::abs(p.z - (z0 + z1) / 2) - (z1 - z0) / 2 + round;
  return std::min(std::max(dx, dz), 0.0) + std::hypot(std::max(dx, 0.0), std::max(dz, 0.0)) - round;
}

/// A point of a limb: where, and how thick.
struct Knot {
  Vector3 at;
  double radius;
};
/// A Catmull–Rom curve through the knots, `steps` points for each span.
inline std::vector<Knot> curve(const std::vector<Knot>& knots, int steps) {
  std::vector<Knot> out;
  const int n = static_cast<int>(knots.size());
  const auto at = [&](int i) { return knots[static_cast<std::size_t>(std::clamp(i, 0, n - 1))]; };
  for (int i = 0; i + 1 < n; ++i) {
    const Knot a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
    for (int s = 0; s < steps + (i + 2 == n); ++s) {
      const double t = static_cast<double>(s) / steps, t2 = t * t, t3 = t2 * t;
      const auto weigh = [&](auto p, auto q, auto r, auto w) {
        return (0.5 * (-t3 + 2 * t2 - t)) * p + (0.5 * (3 * t3 - 5 * t2 + 2)) * q + (0.5 * (-3 * t3 + 4 * t2 + t)) * r +
               (0.5 * (t3 - t2)) * w;
      };
      out.push_back({weigh(a.at, b.at, c.at, d.at), std::max(weigh(a.radius, b.radius, c.radius, d.radius), 0.002)});
    }
  }
  return out;
}
/// The body along a curve.
inline double limb(const Vector3& p, const std::vector<Knot>& curve) {
  double d = 1e9;
  for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
    const auto &a = curve[i], &b = curve[i + 1];
    const Vector3 m = 0.5 * (a.at + b.at);
    if (length(p - m) - 0.5 * length(b.at - a.at) - std::max(a.radius, b.radius) > d) continue;
    d = std::min(d, cone(p, a.at, b.at, a.radius, b.radius));
  }
  return d;
}

/// The surface where the field is 0, inside the box, on a grid of the given step: surface nets (Gibson 1998), moved onto the surface by
/// Newton steps. `lipschitz` bounds how fast the field changes.
orbc::mesh::Mesh surface_of(const Field& field, const Vector3& low, const Vector3& high, double step, double lipschitz = 1.5);

/// A figure of exactly this many triangles or a few fewer, on z = 0, largest error over its size printed.
orbc::mesh::Mesh simplified(const orbc::mesh::Mesh& mesh, std::size_t triangles, const char* name);

Field statue();
Field dragon();

}  // namespace make_meshes
