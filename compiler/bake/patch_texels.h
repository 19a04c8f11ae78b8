#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "compiler/bake/adaptive_grid.h"
#include "compiler/bake/rect_packing.h"
#include "compiler/image/image.h"
#include "compiler/place/interior.h"

namespace orbc::bake {

/// The texels of a patch, `width` × `height`, row by row. The outer ones lie on the corners and edges of the patch.
struct PatchTexels {
  int width = 0, height = 0;
  std::vector<std::array<std::uint8_t, 4>> rgba;    ///< sRGB; alpha 0 in holes
  std::vector<std::array<std::uint16_t, 3>> rgb16;  ///< sRGB of 16 bits a channel, or empty
  std::vector<std::array<float, 3>> light;          ///< the linear colours themselves, where any is above white; else empty
};
/// Colours this much above white count as above it.
inline constexpr double kAboveWhite = 1 + 1.0 / 256;

/// Encodes linear colours. In: the style of the patch decides whether there are holes.
[[nodiscard]] PatchTexels encode_texels(const place::Interior& interior, const TexelPatch& patch, const ColorGrid& colors, bool with_rgb16);

/// The colours of texels above white (PatchTexels::light), dimmed by mirrors before they are cut off. In: the mirrors' throughput.
[[nodiscard]] PatchTexels encode_dimmed(const PatchTexels& texels, const scene::Color& weight, bool with_rgb16);

/// Where the texels of a rectangle are to be copied from, row by row.
struct TexelSource {
  const std::array<std::uint8_t, 4>* rgba = nullptr;
  const std::array<std::uint16_t, 3>* rgb16 = nullptr;  ///< null: there are none
};

/// A picture of the packed size: in its top left corner `base`, which may be empty, then the texels in their rectangles, and grey where
/// nothing lies. In: a source per rectangle.
[[nodiscard]] image::Image assemble_image(const image::Image& base, const std::vector<TexelSource>& sources, const PackedRects& packed);
/// The picture of 16 bits a channel. In: sources with rgb16.
[[nodiscard]] image::Image16 assemble_image16(const image::Image16& base, const std::vector<TexelSource>& sources,
                                              const PackedRects& packed);

/// The colour that a picture shows at (u, v) of a rectangle of at least 2 × 2 texels, in linear light: bilinear between texel centres, from
/// corner to corner. u and v are clamped to [0, 1].
[[nodiscard]] scene::Color color_in_rect(const image::Image& image, const TexelRect& rect, double u, double v);
/// The same of linear colours, row by row. In: the size of `rect`.
[[nodiscard]] scene::Color color_in_rect(const std::vector<std::array<float, 3>>& light, const TexelRect& rect, double u, double v);

}  // namespace orbc::bake
