#include "compiler/bake/highlight_pack.h"

#include <algorithm>
#include <cmath>

#include "compiler/image/image.h"

namespace orbc::bake {

std::optional<std::array<int, 2>> pack_below(std::vector<Box*>& boxes, int width, int top, int max_side) {
  std::stable_sort(boxes.begin(), boxes.end(), [](const Box* a, const Box* b) { return a->height > b->height; });
  std::int64_t area = 0;
  for (const Box* box : boxes) area += static_cast<std::int64_t>(box->width) * box->height, width = std::max(width, box->width);
  int wide = 16;
  while (wide < width) wide *= 2;
  while (wide * 2 <= max_side && top + area / wide > wide) wide *= 2;
  if (wide > max_side) return std::nullopt;
  std::int64_t y = top, shelf = 0;
  int x = 0;
  for (Box* box : boxes) {
    if (x + box->width > wide) y += shelf, shelf = 0, x = 0;
    if (y + box->height > max_side) return std::nullopt;
    box->x = x, box->y = static_cast<int>(y);
    x += box->width;
    shelf = std::max<std::int64_t>(shelf, box->height);
  }
  return std::array<int, 2>{wide, static_cast<int>(y + shelf)};
}

void enlarge(Baked& baked, int width, int height) {
  Atlas& atlas = baked.atlas;
  image::Image larger{width, height,
                      std::vector<std::uint8_t>(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 128)};
  for (std::size_t i = 3; i < larger.rgba.size(); i += 4) larger.rgba[i] = 255;
  for (int y = 0; y < atlas.image.height; ++y) {
    const auto from = atlas.image.rgba.begin() + 4 * static_cast<std::ptrdiff_t>(y) * atlas.image.width;
    std::copy(from, from + 4 * static_cast<std::ptrdiff_t>(atlas.image.width),
              larger.rgba.begin() + 4 * static_cast<std::ptrdiff_t>(y) * width);
  }
  const double u = static_cast<double>(atlas.image.width) / width, v = static_cast<double>(atlas.image.height) / height;
  for (auto& part : atlas.uv)
    for (auto& at : part) at = {static_cast<float>(u * static_cast<double>(at[0])), static_cast<float>(v * static_cast<double>(at[1]))};
  if (!atlas.image16.rgb.empty()) {
    image::Image16 finer{width, height,
                         std::vector<std::uint16_t>(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 128 * 257)};
    for (int y = 0; y < atlas.image16.height; ++y) {
      const auto from = atlas.image16.rgb.begin() + 3 * static_cast<std::ptrdiff_t>(y) * atlas.image16.width;
      std::copy(from, from + 3 * static_cast<std::ptrdiff_t>(atlas.image16.width),
                finer.rgb.begin() + 3 * static_cast<std::ptrdiff_t>(y) * width);
    }
    atlas.image16 = std::move(finer);
  }
  atlas.image = std::move(larger);
}

void put(const Box& box, const std::vector<scene::Color>& shown, const std::vector<std::uint8_t>& holes, Atlas& atlas) {
  image::Image& image = atlas.image;
  for (int y = 0; y < box.height; ++y)
    for (int x = 0; x < box.width; ++x) {
      const std::size_t from = static_cast<std::size_t>(y) * static_cast<std::size_t>(box.width) + static_cast<std::size_t>(x);
      const std::size_t at =
          static_cast<std::size_t>(box.y + y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(box.x + x);
      const double channels[] = {shown[from].r, shown[from].g, shown[from].b};
      for (std::size_t k = 0; k < 3; ++k) {
        image.rgba[4 * at + k] = static_cast<std::uint8_t>(std::lround(255 * channels[k]));
        if (!atlas.image16.rgb.empty()) atlas.image16.rgb[3 * at + k] = static_cast<std::uint16_t>(std::lround(65535 * channels[k]));
      }
      if (!holes.empty()) image.rgba[4 * at + 3] = holes[from] ? 0 : 255;
    }
}

}  // namespace orbc::bake
