#pragma once
#include <cmath>

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
  return space == Space::spherical ? std::cos(s) : space == Space::euclidean ? 1 : std::cosh(s);
}
[[nodiscard]] inline double sin_k(Space space, double s) {
  return space == Space::spherical ? std::sin(s) : space == Space::euclidean ? s : std::sinh(s);
}
[[nodiscard]] inline double tan_k(Space space, double s) {
  return space == Space::spherical ? std::tan(s) : space == Space::euclidean ? s : std::tanh(s);
}
[[nodiscard]] inline double asin_k(Space space, double v) {
  return space == Space::spherical ? std::asin(v < -1 ? -1 : v > 1 ? 1 : v) : space == Space::euclidean ? v : std::asinh(v);
}
[[nodiscard]] inline double atan_k(Space space, double v) {
  return space == Space::spherical ? std::atan(v) : space == Space::euclidean ? v : std::atanh(v);
}
/// Arc length r ≥ 0 of the point at (w, ρ) = (cosκ r, sinκ r); accurate for all r.
[[nodiscard]] inline double arc_k(Space space, double w, double rho) {
  return space == Space::spherical ? std::atan2(rho, w) : space == Space::euclidean ? rho : std::asinh(rho);
}

}  // namespace orbc::geometry
