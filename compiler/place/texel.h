#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "compiler/image/image.h"
#include "compiler/place/placed.h"

namespace orbc::place {

/// The texel (RGBA) of a picture at (u, v), in repeats, v downwards: the nearest one, by one rule for all who ask.
[[nodiscard]] inline const std::uint8_t* texel(const image::Image& image, double u, double v) {
  const auto index = [](double t, int n) { return std::clamp(static_cast<int>(std::floor((t - std::floor(t)) * n)), 0, n - 1); };
  return image.rgba.data() + 4 * (static_cast<std::size_t>(index(v, image.height)) * static_cast<std::size_t>(image.width) +
                                  static_cast<std::size_t>(index(u, image.width)));
}

/// Whether a look has holes: texels of too little alpha, where there is no surface.
[[nodiscard]] inline bool has_holes(const Look& look) { return look.texture >= 0 && look.cutoff >= 0; }
[[nodiscard]] inline bool has_holes(const PlacedRoom& room) {
  return std::any_of(room.looks.begin(), room.looks.end(), [](const Look& look) { return has_holes(look); });
}
/// Whether a texel of so much alpha is a hole of such a look.
[[nodiscard]] inline bool is_hole(std::uint8_t alpha, const Look& look) { return alpha < look.cutoff * 255; }

/// Whether the point of a triangle at affine barycentric coordinates lies in a hole.
[[nodiscard]] inline bool in_hole(const PlacedRoom& room, const PlacedMesh& part, std::size_t triangle, const double (&b)[3]) {
  const Look& look = room.looks[part.look[triangle]];
  if (!has_holes(look) || part.uv.empty()) return false;
  double uv[2] = {0, 0};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t c = 0; c < 2; ++c) uv[c] += b[k] * static_cast<double>(part.uv[part.triangles[triangle][k]][c]);
  // Uv lie in [0, 1]: 1 is the last texel of this repeat, not the first of the next.
  for (double& c : uv) c = std::clamp(c, 0.0, 1 - 1e-9);
  return is_hole(texel(room.textures[static_cast<std::size_t>(look.texture)], uv[0], uv[1])[3], look);
}

}  // namespace orbc::place
