#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "compiler/surface/normals.h"

namespace orbc::bake {

/// Two neighbouring triangles of one style, or a single one, as a square of the atlas. Corners 00, 10 and 01 are those of `first`; corner
/// 11 is the corner of `second` that `first` does not have. u runs from 00 to 10, v from 00 to 01, each from 0 to 1.
struct TexelPatch {
  std::uint32_t part = 0;
  std::uint32_t first = 0;
  int second = -1;                                  ///< −1: a single triangle
  std::array<int, 3> corner_order{0, 1, 2};         ///< which corners of `first` stand at 00, 10, 01
  std::array<int, 3> second_corner_order{0, 1, 2};  ///< which corners of `second` stand at 11, 01, 10
  double length_u = 0, length_v = 0;                ///< of the longer of the two opposite sides, intrinsic
};

/// Pairs the triangles of a part across their longest edge where light may be interpolated over it: both have the same style and the same
/// normals at its ends. All other triangles stay single.
[[nodiscard]] std::vector<TexelPatch> make_patches(const place::Interior& interior, std::uint32_t part,
                                                   const surface::PartNormals& normals);

/// A corner of a patch: corner k of a triangle. In: far_u, far_v say whether u, v is 1 there; both only of pairs.
struct PatchCorner {
  std::size_t triangle = 0, k = 0;
};
[[nodiscard]] PatchCorner corner_of(const TexelPatch& patch, bool far_u, bool far_v);

/// A point of a triangle by affine barycentric coordinates, in the order of the triangle's corners.
struct BarycentricPoint {
  std::size_t triangle = 0;
  std::array<double, 3> b{};
};
/// The point (u, v) of a patch.
[[nodiscard]] BarycentricPoint barycentric_point(const TexelPatch& patch, double u, double v);
/// The point (u, v) of a patch, moved towards its middle by the fraction `share` of its distance.
[[nodiscard]] inline BarycentricPoint inset_point(const TexelPatch& patch, double u, double v, double share) {
  const double middle = patch.second < 0 ? 1.0 / 3 : 0.5;
  return barycentric_point(patch, u + share * (middle - u), v + share * (middle - v));
}

/// The colour of the surface at (u, v), without light.
[[nodiscard]] scene::Color albedo_at(const place::Interior& interior, const place::PlacedMesh& mesh, const TexelPatch& patch, double u,
                                     double v);

/// Whether (u, v) lies in a hole of the surface (SurfaceStyle::alpha_cutoff). Beyond the long side of a single triangle the nearest point
/// of that side decides.
[[nodiscard]] bool is_masked_at(const place::Interior& interior, const TexelPatch& patch, double u, double v);
/// Whether the point (i, j) of a grid of w × h points from corner to corner lies on the patch. A single triangle has only half of them.
[[nodiscard]] inline bool on_patch(const TexelPatch& patch, int i, int j, int w, int h) {
  return patch.second >= 0 ||
         static_cast<std::int64_t>(i) * (h - 1) + static_cast<std::int64_t>(j) * (w - 1) <= static_cast<std::int64_t>(w - 1) * (h - 1);
}

}  // namespace orbc::bake
