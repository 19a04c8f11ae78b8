// With u = x + iy the Möbius map acts on ambient vectors by
//   u' = a²u − κb²ū + 2ab·w,   w' = (|a|² − κ|b|²)·w − 2κ·Re(a b̄ u)
// (insert z = u/(1+w) and use |−κb̄z + ā|² + κ|az + b|² = 1 + κ|z|²). With κ = 0 and w = 1 it is u' = a²u + 2ab: SE(2).
// The reflection in the unit covector (w, l) is a = il, b = iw, reversing: then −κb² = κw² = 1 − |l|², a² = −l², 2ab = −2lw.
#include "compiler/geometry/isometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compiler/base/elementary.h"

namespace orbc::geometry {
namespace {

using Complex = std::complex<double>;

Ambient apply(const Isometry& m, const Ambient& v) {
  const double k = curvature(m.space);
  const Complex u(v.x, m.reversing ? -v.y : v.y);
  const Complex image = m.a * m.a * u - k * m.b * m.b * std::conj(u) + 2.0 * m.a * m.b * v.w;
  const double w = (std::norm(m.a) - k * std::norm(m.b)) * v.w - 2 * k * (m.a * std::conj(m.b) * u).real();
  return {w, image.real(), image.imag()};
}

}  // namespace

Isometry identity(Space space) { return {space, 1, 0, false}; }

Isometry rotation(Space space, double radians) { return {space, math::polar(1.0, radians / 2), 0, false}; }

Isometry translation_to(Space space, const Point& p) {
  if (space == Space::euclidean) return {space, 1, Complex(p.x, p.y) / 2.0, false};
  if (space == Space::spherical && p.w < 0) {
    // cos(d/2) from sin(d/2), which is the large one here.
    const double rho = math::hypot(p.x, p.y), s = std::sqrt((1 - p.w) / 2);
    return {space, rho / (2 * s), s * Complex(p.x, p.y) / rho, false};
  }
  const double c = std::sqrt((1 + p.w) / 2);
  return {space, c, Complex(p.x, p.y) / (2 * c), false};
}

Isometry translation_by(Space space, double x, double y) {
  const double d = math::hypot(x, y);
  if (d == 0) return identity(space);
  return {space, cos_k(space, d / 2), sin_k(space, d / 2) * Complex(x, y) / d, false};
}

Isometry reflection(Space space, const Line& line) { return {space, Complex(0, 1) * Complex(line.x, line.y), Complex(0, line.w), true}; }

Isometry operator*(const Isometry& l, const Isometry& r) {
  const double k = curvature(l.space);
  const Complex a = l.reversing ? std::conj(r.a) : r.a, b = l.reversing ? std::conj(r.b) : r.b;
  return {l.space, l.a * a - k * l.b * std::conj(b), l.a * b + l.b * std::conj(a), l.reversing != r.reversing};
}

Isometry inverse(const Isometry& m) {
  if (m.reversing) return {m.space, m.a, -std::conj(m.b), true};
  return {m.space, std::conj(m.a), -m.b, false};
}

Isometry renormalised(const Isometry& m) {
  if (m.space == Space::euclidean) {
    const double s = 1 / math::abs(m.a);
    return {m.space, s * m.a, m.b * s, m.reversing};
  }
  if (m.space == Space::spherical) {
    const double s = 1 / std::sqrt(std::norm(m.a) + std::norm(m.b));
    return {m.space, s * m.a, s * m.b, m.reversing};
  }
  // |a|² − |b|² would cancel; instead |a| follows from |b|.
  const double s = std::sqrt(1 + std::norm(m.b)) / math::abs(m.a);
  return {m.space, s * m.a, m.b, m.reversing};
}

Point operator*(const Isometry& m, const Point& p) {
  const Ambient v = apply(m, p);
  if (m.space == Space::hyperbolic) return {std::sqrt(1 + v.x * v.x + v.y * v.y), v.x, v.y};
  return {m.space == Space::euclidean ? 1 : v.w, v.x, v.y};
}

Tangent operator*(const Isometry& m, const Tangent& t) {
  const Ambient v = apply(m, t);
  return {v.w, v.x, v.y};
}

Line operator*(const Isometry& m, const Line& line) {
  // A covector l is the vector (κw, x, y) up to the form; for κ = 0 the offset transforms separately: w' = w − l'·(translation).
  const Complex l(line.x, m.reversing ? -line.y : line.y);
  if (m.space == Space::euclidean) {
    const Complex image = m.a * m.a * l, shift = 2.0 * m.a * m.b;
    return {line.w - (image * std::conj(shift)).real(), image.real(), image.imag()};
  }
  const double k = curvature(m.space);
  const Ambient v = apply(m, {k * line.w, line.x, line.y});
  return {k * v.w, v.x, v.y};
}

Matrix3 matrix(const Isometry& m) {
  const Ambient w = apply(m, {1, 0, 0}), x = apply(m, {0, 1, 0}), y = apply(m, {0, 0, 1});
  return {{{w.w, x.w, y.w}, {w.x, x.x, y.x}, {w.y, x.y, y.y}}};
}

Ambient operator*(const Matrix3& m, const Ambient& v) {
  return {m[0][0] * v.w + m[0][1] * v.x + m[0][2] * v.y, m[1][0] * v.w + m[1][1] * v.x + m[1][2] * v.y,
          m[2][0] * v.w + m[2][1] * v.x + m[2][2] * v.y};
}

double difference(const Isometry& l, const Isometry& r) {
  if (l.reversing != r.reversing) return std::numeric_limits<double>::infinity();
  const double same = std::max(math::abs(l.a - r.a), math::abs(l.b - r.b));
  const double opposite = std::max(math::abs(l.a + r.a), math::abs(l.b + r.b));
  return std::min(same, opposite);
}

}  // namespace orbc::geometry
