#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "compiler/image/image.h"
#include "compiler/place/interior.h"

namespace orbc::place {

/// The nearest texel (RGBA) of an image at (u, v), in repeats, with v downwards. All rooms look up texels by this one rule.
[[nodiscard]] inline const std::uint8_t* texel(const image::Image& image, double u, double v) {
  const auto index = [](double t, int n) { return std::clamp(static_cast<int>(std::floor((t - std::floor(t)) * n)), 0, n - 1); };
  return image.rgba.data() + 4 * (static_cast<std::size_t>(index(v, image.height)) * static_cast<std::size_t>(image.width) +
                                  static_cast<std::size_t>(index(u, image.width)));
}

/// Whether a style has an alpha mask: there is no surface at texels with too little alpha.
[[nodiscard]] inline bool has_alpha_mask(const SurfaceStyle& style) { return style.texture >= 0 && style.alpha_cutoff >= 0; }
[[nodiscard]] inline bool has_alpha_mask(const Interior& interior) {
  return std::any_of(interior.styles.begin(), interior.styles.end(), [](const SurfaceStyle& style) { return has_alpha_mask(style); });
}
/// Whether a texel of this alpha is masked in this style.
[[nodiscard]] inline bool is_masked(std::uint8_t alpha, const SurfaceStyle& style) { return alpha < style.alpha_cutoff * 255; }

/// The factor of the style's colour at affine barycentric coordinates of a triangle. In: a mesh with colours.
template <class Coordinates>
[[nodiscard]] scene::Color interpolated_color(const PlacedMesh& part, std::size_t triangle, const Coordinates& b) {
  scene::Color sum{0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const mesh::LinearColor& c = part.color[part.triangles[triangle][k]];
    sum = sum + b[k] * scene::Color{static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
  }
  return sum;
}

/// Whether the point of a triangle with the affine barycentric coordinates b is masked.
[[nodiscard]] inline bool is_masked_at(const Interior& interior, const PlacedMesh& part, std::size_t triangle, const double (&b)[3]) {
  const SurfaceStyle& style = interior.styles[part.style[triangle]];
  if (!has_alpha_mask(style) || part.uv.empty()) return false;
  double uv[2] = {0, 0};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t c = 0; c < 2; ++c) uv[c] += b[k] * static_cast<double>(part.uv[part.triangles[triangle][k]][c]);
  // Uv lie in [0, 1]: 1 is the last texel of this repeat, not the first of the next.
  for (double& c : uv) c = std::clamp(c, 0.0, 1 - 1e-9);
  return is_masked(texel(interior.textures[static_cast<std::size_t>(style.texture)], uv[0], uv[1])[3], style);
}

}  // namespace orbc::place
