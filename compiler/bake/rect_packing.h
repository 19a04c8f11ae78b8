#pragma once
#include <optional>
#include <vector>

namespace orbc::bake {

/// A rectangle of texels in a picture.
struct TexelRect {
  int width = 0, height = 0, x = 0, y = 0;
};

/// Rectangles with their places, in the order in which they were given, and the size of the picture that holds them.
struct PackedRects {
  std::vector<TexelRect> rects;
  int width = 0, height = 0;
};

/// Packs rectangles on shelves, tallest first.
/// Makes: a picture whose width is a power of two, as small as lets it be no higher than wide (or as wide as max_side), and at least 4
///        texels high. Nothing if a side would exceed max_side.
[[nodiscard]] std::optional<PackedRects> pack_rects(std::vector<TexelRect> rects, int max_side);

/// Packs rectangles in the same way below the first `top` rows of a picture of the given width.
/// Makes: the size of the whole picture, as wide as before or wider. Nothing if a side would exceed max_side.
[[nodiscard]] std::optional<PackedRects> pack_below(std::vector<TexelRect> rects, int width, int top, int max_side);

}  // namespace orbc::bake
