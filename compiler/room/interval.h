#pragma once
#include <algorithm>

#include "compiler/room/real.h"

namespace orbc::room {

/// A closed interval that contains the true value. Every operation widens its result by 2^-160 of its size. That is far more than the half
/// ulp (2^-168) of a basic operation or a square root and the few ulps of a sine, so the result contains the true value in every rounding
/// mode.
class Interval {
 public:
  Interval(double value) : low_(value), high_(value) {}
  [[nodiscard]] static Interval around(const Real& low, const Real& high) {
    const Real more = ldexp(std::max(abs(low), abs(high)), -160);
    return {low - more, high + more};
  }
  [[nodiscard]] const Real& low() const { return low_; }
  [[nodiscard]] const Real& high() const { return high_; }
  /// Largest absolute value.
  [[nodiscard]] Real magnitude() const { return std::max(abs(low_), abs(high_)); }

  friend Interval operator+(const Interval& a, const Interval& b) { return around(a.low_ + b.low_, a.high_ + b.high_); }
  friend Interval operator-(const Interval& a, const Interval& b) { return around(a.low_ - b.high_, a.high_ - b.low_); }
  friend Interval operator-(const Interval& a) { return {-a.high_, -a.low_}; }
  friend Interval operator*(const Interval& a, const Interval& b) {
    const Real p = a.low_ * b.low_, q = a.low_ * b.high_, r = a.high_ * b.low_, s = a.high_ * b.high_;
    return around(std::min({p, q, r, s}), std::max({p, q, r, s}));
  }
  /// In: b > 0.
  friend Interval operator/(const Interval& a, const Interval& b) {
    return around(a.low_ / (a.low_ < 0 ? b.low_ : b.high_), a.high_ / (a.high_ < 0 ? b.high_ : b.low_));
  }
  /// In: a > 0.
  friend Interval sqrt(const Interval& a) { return around(sqrt(a.low_), sqrt(a.high_)); }

 private:
  Interval(Real low, Real high) : low_(std::move(low)), high_(std::move(high)) {}
  Real low_, high_;
};

}  // namespace orbc::room
