#include "compiler/bake/patch_texels.h"

#include <algorithm>
#include <cstddef>

#include "compiler/bake/atlas.h"
#include "compiler/image/srgb.h"
#include "compiler/place/alpha_mask.h"

namespace orbc::bake {
namespace {

using scene::Color;

/// Copies rows of `columns` elements between arrays of different widths, all counted in elements.
template <class From, class To>
void copy_rows(From from, std::ptrdiff_t from_width, To to, std::ptrdiff_t to_width, std::ptrdiff_t columns, int rows) {
  for (int y = 0; y < rows; ++y) std::copy(from + y * from_width, from + y * from_width + columns, to + y * to_width);
}

std::ptrdiff_t texel_index(int width, const TexelRect& rect, int x, int y) {
  return static_cast<std::ptrdiff_t>(rect.y + y) * width + rect.x + x;
}

Color texel(const image::Image& image, int x, int y) {
  const std::uint8_t* p =
      image.rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
  return {image::decode_srgb8(p[0]), image::decode_srgb8(p[1]), image::decode_srgb8(p[2])};
}

}  // namespace

PatchTexels encode_texels(const place::Interior& interior, const TexelPatch& patch, const ColorGrid& colors, bool with_rgb16) {
  const place::PlacedMesh& mesh = interior.parts[patch.part];
  const bool has_alpha_mask = place::has_alpha_mask(interior.styles[mesh.style[patch.first]]);
  PatchTexels texels{colors.width, colors.height, {}, {}, {}};
  texels.rgba.reserve(colors.color.size());
  for (int j = 0; j < colors.height; ++j)
    for (int i = 0; i < colors.width; ++i) {
      const Color& c = colors.color[colors.index(i, j)];
      const double u = static_cast<double>(i) / (colors.width - 1), v = static_cast<double>(j) / (colors.height - 1);
      const std::uint8_t alpha = has_alpha_mask && is_masked_at(interior, patch, u, v) ? 0 : 255;
      texels.rgba.push_back({image::encode_srgb8(c.r), image::encode_srgb8(c.g), image::encode_srgb8(c.b), alpha});
      if (with_rgb16) texels.rgb16.push_back({image::encode_srgb16(c.r), image::encode_srgb16(c.g), image::encode_srgb16(c.b)});
    }
  if (std::any_of(colors.color.begin(), colors.color.end(), [](const Color& c) { return max_channel(c) > kAboveWhite; }))
    for (const Color& c : colors.color) texels.light.push_back({static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)});
  return texels;
}

PatchTexels encode_dimmed(const PatchTexels& texels, const Color& weight, bool with_rgb16) {
  PatchTexels dimmed{texels.width, texels.height, {}, {}, {}};
  dimmed.rgba.reserve(texels.light.size());
  for (std::size_t i = 0; i < texels.light.size(); ++i) {
    const auto& l = texels.light[i];
    const Color c = weight * Color{static_cast<double>(l[0]), static_cast<double>(l[1]), static_cast<double>(l[2])};
    dimmed.rgba.push_back({image::encode_srgb8(c.r), image::encode_srgb8(c.g), image::encode_srgb8(c.b), texels.rgba[i][3]});
    if (with_rgb16) dimmed.rgb16.push_back({image::encode_srgb16(c.r), image::encode_srgb16(c.g), image::encode_srgb16(c.b)});
  }
  return dimmed;
}

image::Image assemble_image(const image::Image& base, const std::vector<TexelSource>& sources, const PackedRects& packed) {
  image::Image image = blank_image(packed.width, packed.height);
  copy_rows(base.rgba.begin(), 4 * std::ptrdiff_t{base.width}, image.rgba.begin(), 4 * std::ptrdiff_t{image.width},
            4 * std::ptrdiff_t{base.width}, base.height);
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const std::array<std::uint8_t, 4>* texel = sources[k].rgba;
    for (int y = 0; y < packed.rects[k].height; ++y)
      for (int x = 0; x < packed.rects[k].width; ++x, ++texel)
        std::copy(texel->begin(), texel->end(), image.rgba.begin() + 4 * texel_index(image.width, packed.rects[k], x, y));
  }
  return image;
}

image::Image16 assemble_image16(const image::Image16& base, const std::vector<TexelSource>& sources, const PackedRects& packed) {
  image::Image16 image = blank_image16(packed.width, packed.height);
  copy_rows(base.rgb.begin(), 3 * std::ptrdiff_t{base.width}, image.rgb.begin(), 3 * std::ptrdiff_t{image.width},
            3 * std::ptrdiff_t{base.width}, base.height);
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const std::array<std::uint16_t, 3>* texel = sources[k].rgb16;
    for (int y = 0; y < packed.rects[k].height; ++y)
      for (int x = 0; x < packed.rects[k].width; ++x, ++texel)
        std::copy(texel->begin(), texel->end(), image.rgb.begin() + 3 * texel_index(image.width, packed.rects[k], x, y));
  }
  return image;
}

namespace {

/// Bilinear between texels. In: texel(column, row).
template <class Texel>
Color bilinear(const TexelRect& rect, double u, double v, const Texel& texel_at) {
  const double x = std::clamp(u, 0.0, 1.0) * (rect.width - 1), y = std::clamp(v, 0.0, 1.0) * (rect.height - 1);
  const int i = std::min(static_cast<int>(x), rect.width - 2), j = std::min(static_cast<int>(y), rect.height - 2);
  const double s = x - i, t = y - j;
  return (1 - t) * ((1 - s) * texel_at(i, j) + s * texel_at(i + 1, j)) + t * ((1 - s) * texel_at(i, j + 1) + s * texel_at(i + 1, j + 1));
}

}  // namespace

Color color_in_rect(const image::Image& image, const TexelRect& rect, double u, double v) {
  return bilinear(rect, u, v, [&](int column, int row) { return texel(image, rect.x + column, rect.y + row); });
}

Color color_in_rect(const std::vector<std::array<float, 3>>& light, const TexelRect& rect, double u, double v) {
  return bilinear(rect, u, v, [&](int column, int row) {
    const auto& c = light[static_cast<std::size_t>(row) * static_cast<std::size_t>(rect.width) + static_cast<std::size_t>(column)];
    return Color{static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
  });
}

}  // namespace orbc::bake
