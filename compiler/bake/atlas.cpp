// Renderers look a texture up between texels in ways of their own (POV-Ray blends linear light and wraps at the borders, Cycles blends
// encoded values and clamps), so nothing may depend on it: plain colours are squares of texels read in their middle, and
// pictures have gutters.
#include "compiler/bake/atlas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>

#include "compiler/bake/rect_packing.h"
#include "compiler/image/srgb.h"

namespace orbc::bake {
namespace {

using place::PartKind;
using place::PlacedMesh;
using place::SurfaceStyle;
using Texel = std::array<std::uint8_t, 4>;

constexpr int kColorTexels = 4;  // a side of a plain colour: its middle is a corner of four texels, each a whole texel from the border
constexpr int kGutter = 4;       // texels around a picture

/// What a style needs of the atlas: a colour, or a tinted picture.
struct Cell {
  int texture = -1;
  Texel color{};                           ///< of a plain colour
  std::array<std::uint16_t, 3> color16{};  ///< with 16 bits a channel
  std::array<double, 3> tint{1, 1, 1};
  bool tiles = false;
  double cutoff = -1;                               ///< of holes, as in SurfaceStyle
  int width = kColorTexels, height = kColorTexels;  ///< with gutters
  int x = 0, y = 0;
  [[nodiscard]] auto key() const { return std::tuple(texture, color, color16, tint, tiles, cutoff); }
};

Cell cell_of(const place::Interior& interior, const SurfaceStyle& style, bool tiles) {
  Cell cell;
  if (style.texture < 0) {
    cell.color = {image::encode_srgb8(style.color.r), image::encode_srgb8(style.color.g), image::encode_srgb8(style.color.b), 255};
    cell.color16 = {image::encode_srgb16(style.color.r), image::encode_srgb16(style.color.g), image::encode_srgb16(style.color.b)};
    return cell;
  }
  const image::Image& image = interior.textures[style.texture];
  cell.texture = style.texture;
  cell.tint = {style.color.r, style.color.g, style.color.b};
  cell.tiles = tiles;
  cell.cutoff = style.alpha_cutoff;
  cell.width = image.width + 2 * kGutter;
  cell.height = image.height + 2 * kGutter;
  return cell;
}

/// The cells of the atlas, and the cell of each style.
struct Layout {
  std::vector<Cell> cells;
  std::vector<std::array<int, 2>> of_style;  ///< [style][1 where the picture tiles a panel, else 0]; −1: unused
  int width = 0, height = 0;
};

Layout collect(const place::Interior& interior) {
  Layout layout;
  layout.of_style.assign(interior.styles.size(), {-1, -1});
  std::map<decltype(Cell{}.key()), int> known;
  for (const PlacedMesh& part : interior.parts)
    for (const std::uint16_t style : part.style) {
      const bool tiles = part.kind != PartKind::object;
      int& cell = layout.of_style[style][tiles];
      if (cell >= 0) continue;
      Cell made = cell_of(interior, interior.styles[style], tiles);
      const auto [at, is_new] = known.try_emplace(made.key(), static_cast<int>(layout.cells.size()));
      if (is_new) layout.cells.push_back(made);
      cell = at->second;
    }
  return layout;
}

Texel texel_of(const image::Image& image, const Cell& cell, const std::array<std::array<std::uint8_t, 256>, 3>& tint, int x, int y) {
  const auto wrap = [&cell](int i, int n) { return cell.tiles ? ((i % n) + n) % n : std::clamp(i, 0, n - 1); };
  const std::size_t at = 4 * (static_cast<std::size_t>(wrap(y, image.height)) * image.width + wrap(x, image.width));
  return {tint[0][image.rgba[at]], tint[1][image.rgba[at + 1]], tint[2][image.rgba[at + 2]],
          static_cast<std::uint8_t>(image.rgba[at + 3] < cell.cutoff * 255 ? 0 : 255)};
}

void draw(const place::Interior& interior, const Cell& cell, image::Image& atlas) {
  std::array<std::array<std::uint8_t, 256>, 3> tint;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < 256; ++i) {
      const auto code = static_cast<std::uint8_t>(i);
      tint[c][i] = cell.tint[c] == 1 ? code : image::encode_srgb8(cell.tint[c] * image::decode_srgb8(code));
    }
  for (int y = 0; y < cell.height; ++y)
    for (int x = 0; x < cell.width; ++x) {
      const Texel texel = cell.texture < 0 ? cell.color : texel_of(interior.textures[cell.texture], cell, tint, x - kGutter, y - kGutter);
      std::copy(texel.begin(), texel.end(), atlas.rgba.begin() + 4 * (static_cast<std::ptrdiff_t>(cell.y + y) * atlas.width + cell.x + x));
    }
}

/// Draws a cell with 16 bits a channel, from the full precision of colours and tints.
void draw(const place::Interior& interior, const Cell& cell, image::Image16& atlas) {
  std::array<std::array<std::uint16_t, 256>, 3> tint;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < 256; ++i)
      tint[c][i] = cell.tint[c] == 1 ? static_cast<std::uint16_t>(257 * i)
                                     : image::encode_srgb16(cell.tint[c] * image::decode_srgb8(static_cast<std::uint8_t>(i)));
  std::array<std::array<std::uint8_t, 256>, 3> same;
  for (auto& channel : same) std::iota(channel.begin(), channel.end(), std::uint8_t{0});
  for (int y = 0; y < cell.height; ++y)
    for (int x = 0; x < cell.width; ++x) {
      std::array<std::uint16_t, 3> texel = cell.color16;
      if (cell.texture >= 0) {
        const Texel code = texel_of(interior.textures[cell.texture], cell, same, x - kGutter, y - kGutter);
        texel = {tint[0][code[0]], tint[1][code[1]], tint[2][code[2]]};
      }
      std::copy(texel.begin(), texel.end(), atlas.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(cell.y + y) * atlas.width + cell.x + x));
    }
}

std::array<float, 2> uv_in(const Layout& layout, const Cell& cell, const std::array<float, 2>& own) {
  if (cell.texture < 0)
    return {static_cast<float>((cell.x + kColorTexels / 2.0) / layout.width),
            static_cast<float>((cell.y + kColorTexels / 2.0) / layout.height)};
  const double u = cell.x + kGutter + static_cast<double>(own[0]) * (cell.width - 2 * kGutter);
  const double v = cell.y + kGutter + static_cast<double>(own[1]) * (cell.height - 2 * kGutter);
  return {static_cast<float>(u / layout.width), static_cast<float>(v / layout.height)};
}

/// A part with one place in the atlas for each vertex. Vertices between triangles of different cells are doubled.
struct AddressedPart {
  PlacedMesh mesh;
  std::vector<std::array<float, 2>> uv;
};
AddressedPart address(const Layout& layout, const PlacedMesh& own) {
  AddressedPart part{own, {}};
  PlacedMesh& mesh = part.mesh;
  mesh.floor.clear();
  mesh.z.clear();
  mesh.uv.clear();
  mesh.color.clear();
  mesh.pattern_position.clear();
  // Most vertices belong to one cell, which stands in `first`; only further cells of a vertex go into the map.
  std::vector<std::pair<int, std::uint32_t>> first(own.floor.size(), {-1, 0});
  std::map<std::pair<std::uint32_t, int>, std::uint32_t> others;
  for (std::size_t t = 0; t < own.triangles.size(); ++t) {
    const int cell = layout.of_style[own.style[t]][own.kind != PartKind::object];
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t v = own.triangles[t][i];
      const auto next = static_cast<std::uint32_t>(mesh.floor.size());
      std::uint32_t vertex = next;
      if (first[v].first < 0) first[v] = {cell, next};
      else if (first[v].first == cell) vertex = first[v].second;
      else vertex = others.try_emplace({v, cell}, next).first->second;
      if (vertex == next) {
        mesh.floor.push_back(own.floor[v]);
        mesh.z.push_back(own.z[v]);
        if (!own.uv.empty()) mesh.uv.push_back(own.uv[v]);
        if (!own.color.empty()) mesh.color.push_back(own.color[v]);
        if (!own.pattern_position.empty()) mesh.pattern_position.push_back(own.pattern_position[v]);
        part.uv.push_back(uv_in(layout, layout.cells[cell], own.uv.empty() ? std::array<float, 2>{0, 0} : own.uv[v]));
      }
      mesh.triangles[t][i] = vertex;
    }
  }
  return part;
}

Diagnostic too_large(const Layout& layout, int max_side) {
  const auto largest = std::max_element(layout.cells.begin(), layout.cells.end(), [](const Cell& a, const Cell& b) {
    return static_cast<std::int64_t>(a.width) * a.height < static_cast<std::int64_t>(b.width) * b.height;
  });
  return make_error(
      "light.atlas-too-large", fmt::format("the pictures of this scene do not fit into one of {0}×{0} pixels", max_side),
      fmt::format("the largest picture is {}×{}: make it smaller", largest->width - 2 * kGutter, largest->height - 2 * kGutter));
}

}  // namespace

image::Image blank_image(int width, int height) {
  image::Image image{width, height, std::vector<std::uint8_t>(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 128)};
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
  return image;
}

image::Image16 blank_image16(int width, int height) {
  return {width, height, std::vector<std::uint16_t>(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 128 * 257)};
}

Result<Atlas> make_atlas(const place::Interior& interior, const AtlasOptions& options) {
  Layout layout = collect(interior);
  std::vector<TexelRect> rects;
  for (const Cell& cell : layout.cells) rects.push_back({cell.width, cell.height});
  const auto packed = pack_rects(std::move(rects), options.max_side);
  if (!packed) return too_large(layout, options.max_side);
  layout.width = packed->width;
  layout.height = packed->height;
  for (std::size_t i = 0; i < layout.cells.size(); ++i) {
    layout.cells[i].x = packed->rects[i].x;
    layout.cells[i].y = packed->rects[i].y;
  }
  Atlas atlas;
  atlas.image = blank_image(layout.width, layout.height);
  for (const Cell& cell : layout.cells) draw(interior, cell, atlas.image);
  if (options.with_image16) {
    atlas.image16 = blank_image16(layout.width, layout.height);
    for (const Cell& cell : layout.cells) draw(interior, cell, atlas.image16);
  }
  atlas.room = interior;
  for (PlacedMesh& part : atlas.room.parts) {
    AddressedPart addressed = address(layout, part);
    part = std::move(addressed.mesh);
    atlas.uv.push_back(std::move(addressed.uv));
  }
  return atlas;
}

}  // namespace orbc::bake
