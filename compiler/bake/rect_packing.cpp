#include "compiler/bake/rect_packing.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

namespace orbc::bake {
namespace {

struct Shelves {
  std::vector<TexelRect> rects;
  std::int64_t bottom = 0;  ///< first row below the last shelf
};

/// In: a width not smaller than that of any rectangle. Places below max_side rows are not kept apart: the caller refuses them.
Shelves place_on_shelves(std::vector<TexelRect> rects, int width, int top, int max_side) {
  std::vector<std::uint32_t> order(rects.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return rects[a].height > rects[b].height; });
  std::int64_t y = top, shelf_height = 0;
  int x = 0;
  for (const std::uint32_t i : order) {
    if (x + rects[i].width > width) {
      y += shelf_height;
      shelf_height = 0;
      x = 0;
    }
    rects[i].x = x;
    rects[i].y = static_cast<int>(std::min<std::int64_t>(y, max_side));
    x += rects[i].width;
    shelf_height = std::max<std::int64_t>(shelf_height, rects[i].height);
  }
  return {std::move(rects), y + shelf_height};
}

struct Extent {
  std::int64_t area = 0;
  int widest = 1;
};
Extent extent_of(const std::vector<TexelRect>& rects) {
  Extent extent;
  for (const TexelRect& rect : rects) {
    extent.area += static_cast<std::int64_t>(rect.width) * rect.height;
    extent.widest = std::max(extent.widest, rect.width);
  }
  return extent;
}

}  // namespace

std::optional<PackedRects> pack_rects(std::vector<TexelRect> rects, int max_side) {
  const Extent extent = extent_of(rects);
  for (int width = 16; width <= max_side; width *= 2) {
    const bool is_last = width * 2 > max_side;
    if (width < extent.widest || (static_cast<std::int64_t>(width) * width < extent.area && !is_last)) continue;
    Shelves shelves = place_on_shelves(rects, width, 0, max_side);
    if (shelves.bottom > width && !is_last) continue;
    if (shelves.bottom > max_side) return std::nullopt;
    return PackedRects{std::move(shelves.rects), width, static_cast<int>(std::max<std::int64_t>(shelves.bottom, 4))};
  }
  return std::nullopt;
}

std::optional<PackedRects> pack_below(std::vector<TexelRect> rects, int width, int top, int max_side) {
  const Extent extent = extent_of(rects);
  int wide = 16;
  while (wide < std::max(width, extent.widest)) wide *= 2;
  while (wide * 2 <= max_side && top + extent.area / wide > wide) wide *= 2;
  if (wide > max_side) return std::nullopt;
  Shelves shelves = place_on_shelves(std::move(rects), wide, top, max_side);
  if (shelves.bottom > max_side) return std::nullopt;
  return PackedRects{std::move(shelves.rects), wide, static_cast<int>(shelves.bottom)};
}

}  // namespace orbc::bake
