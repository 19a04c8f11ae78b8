#pragma once
#include <cmath>

#include "compiler/base/elementary.h"

namespace orbc::geometry {

/// The three simply connected surfaces of constant curvature; the value is the curvature κ.
enum class Space : int { hyperbolic = -1, euclidean = 0, spherical = 1 };

[[nodiscard]] constexpr int curvature(Space space) { return static_cast<int>(space); }
[[nodiscard]] constexpr const char* name(Space space) {
  return space == Space::spherical ? "spherical" : space == Space::euclidean ? "euclidean" : "hyperbolic";
}

/// Generalised trigonometry: cosκ, sinκ, tanκ = cos | 1 | cosh, sin | s | sinh, tan | s | tanh, and their inverses.
/// Units: curvature radii for κ = ±1, scene units for κ = 0. Source: design §2.
[[nodiscard]] inline double cos_k(Space space, double s) {
  return space == Space::spherical ? math::cos(s) : space == Space::euclidean ? 1 : math::cosh(s);
}
[[nodiscard]] inline double sin_k(Space space, double s) {
  return space == Space::spherical ? math::sin(s) : space == Space::euclidean ? s : math::sinh(s);
}
[[nodiscard]] inline double tan_k(Space space, double s) {
  return space == Space::spherical ? math::tan(s) : space == Space::euclidean ? s : math::tanh(s);
}
[[nodiscard]] inline double asin_k(Space space, double v) {
  return space == Space::spherical ? math::asin(v < -1 ? -1 : v > 1 ? 1 : v) : space == Space::euclidean ? v : math::asinh(v);
}
[[nodiscard]] inline double atan_k(Space space, double v) {
  return space == Space::spherical ? math::atan(v) : space == Space::euclidean ? v : math::atanh(v);
}
/// Arc length r ≥ 0 of the point at (w, ρ) = (cosκ r, sinκ r); accurate for all r.
[[nodiscard]] inline double arc_k(Space space, double w, double rho) {
  return space == Space::spherical ? math::atan2(rho, w) : space == Space::euclidean ? rho : math::asinh(rho);
}

}  // namespace orbc::geometry
