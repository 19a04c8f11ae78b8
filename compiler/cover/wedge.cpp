#include "compiler/cover/wedge.h"

#include <cmath>

namespace orbc::cover {
namespace {

bool contains(const Wedge& wedge, const Bearing& b) {
  return b == wedge.from || b == wedge.to || (cross(wedge.from, b) >= 0 && cross(b, wedge.to) >= 0);
}

}  // namespace

Bearing snapped(const Bearing& b, const Wedge& wedge) {
  if (std::fabs(cross(wedge.from, b)) < kSameBearingRadians && in_front(wedge.from, b)) return wedge.from;
  if (std::fabs(cross(wedge.to, b)) < kSameBearingRadians && in_front(wedge.to, b)) return wedge.to;
  return b;
}

Bearing clamped(const Bearing& b, const Wedge& wedge) {
  const Bearing near = snapped(b, wedge);
  if (near == wedge.from || near == wedge.to) return near;
  if (cross(wedge.from, near) < 0) return wedge.from;
  return cross(near, wedge.to) < 0 ? wedge.to : near;
}

std::optional<Wedge> intersection(const Wedge& a, const Wedge& b) {
  // After this, borders are equal or further apart than rounding moves them.
  const Bearing from = snapped(b.from, a), to = snapped(b.to, a);
  if (from == a.to || to == a.from) return std::nullopt;
  Wedge both = a;
  if (contains(a, from)) both.from = from;
  else if (!contains(b, a.from)) return std::nullopt;
  if (contains(a, to)) both.to = to;
  if (cross(both.from, both.to) <= 0) return std::nullopt;
  return both;
}

}  // namespace orbc::cover
