#pragma once
// Heavy: only the .cpp files of this room include it.
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "compiler/base/rational.h"
#include "compiler/geometry/space.h"

namespace orbc::room {

/// 168 bits (50 digits): rooms are solved and placed with it and rounded to double once, at the end. A polygon that reaches r radii from
/// its centre loses a factor e^(2r) of precision while it is built; at r = 18, where doubles know nothing any more, 34 digits are left.
using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<168, boost::multiprecision::digit_base_2>,
                                           boost::multiprecision::et_off>;

/// The nearest Real.
[[nodiscard]] inline Real real_of(const Integer& value) { return Real(to_string(value)); }

/// An ambient vector (w, x, y) or a covector of a line, as in geometry/point.h and geometry/line.h.
struct RealVector {
  Real w, x, y;
};
[[nodiscard]] inline RealVector operator+(const RealVector& a, const RealVector& b) { return {a.w + b.w, a.x + b.x, a.y + b.y}; }
[[nodiscard]] inline RealVector operator-(const RealVector& a, const RealVector& b) { return {a.w - b.w, a.x - b.x, a.y - b.y}; }
[[nodiscard]] inline RealVector operator*(const Real& s, const RealVector& a) { return {s * a.w, s * a.x, s * a.y}; }

/// The value of a covector at a vector.
[[nodiscard]] inline Real value_at(const RealVector& line, const RealVector& v) { return line.w * v.w + line.x * v.x + line.y * v.y; }
/// κ·w·w' + x·x' + y·y': 1 for unit tangents and unit lines, κ for points of S² and H².
[[nodiscard]] inline Real inner(int k, const RealVector& a, const RealVector& b) { return k * (a.w * b.w) + a.x * b.x + a.y * b.y; }
/// Of two points: the line from the first through the second. Of two lines: their intersection.
[[nodiscard]] inline RealVector cross(const RealVector& p, const RealVector& q) {
  return {p.x * q.y - p.y * q.x, p.y * q.w - p.w * q.y, p.w * q.x - p.x * q.w};
}
/// Between vectors and covectors.
[[nodiscard]] inline RealVector dual(int k, const RealVector& a) { return {k * a.w, a.x, a.y}; }

[[nodiscard]] inline const Real& real_pi() {
  static const Real pi = acos(Real(-1));
  return pi;
}

}  // namespace orbc::room
