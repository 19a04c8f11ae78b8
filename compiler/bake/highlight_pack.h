#pragma once
#include <array>
#include <optional>
#include <vector>

#include "compiler/bake/bake.h"

namespace orbc::bake {

/// Puts boxes on shelves below the first `top` rows of a picture. Makes: its size, as wide as before or wider, or nothing when it does not
/// fit.
[[nodiscard]] std::optional<std::array<int, 2>> pack_below(std::vector<Box*>& boxes, int width, int top, int max_side);

/// Gives the atlas more room to the right and below, and moves the places in it. In: a size not smaller than before.
void enlarge(Baked& baked, int width, int height);

/// Writes the texels of a box into the atlas: encoded colours 0…1, and, where there are any, which are holes.
void put(const Box& box, const std::vector<scene::Color>& shown, const std::vector<std::uint8_t>& holes, Atlas& atlas);

}  // namespace orbc::bake
