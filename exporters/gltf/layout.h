#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "compiler/driver/product.h"

namespace orbc::gltf {

/// A run of copies that becomes one primitive: neighbours in the product's arrays.
struct Part {
  std::size_t first_copy = 0, copy_count = 0;
  std::size_t first_vertex = 0, vertex_count = 0;
  std::size_t first_index = 0, index_count = 0;
  std::optional<std::size_t> object;                   ///< whose triangles they are (Product::objects)
  bool glows = false;                                  ///< its colours are its light, whatever lamps there are
  int index_bytes = 4;                                 ///< 2 where every index is below 65535
  std::array<float, 3> low{}, high{};                  ///< of the positions, in glTF's axes
  std::size_t position_at = 0, normal_at = 0, uv_at = 0, color_at = 0, index_at = 0;  ///< byte offsets in the binary chunk
};

/// What stands where in the binary chunk: all positions, normals, uv, colours, indices, then the atlas.
struct Layout {
  std::vector<Part> parts;
  bool has_uv = false, has_color = false, has_normals = false;
  std::size_t position_bytes = 0, normal_at = 0, normal_bytes = 0, uv_at = 0, uv_bytes = 0, color_at = 0, color_bytes = 0, index_at = 0,
              index_bytes = 0, atlas_at = 0;
  std::size_t atlas_bytes = 0;      ///< 0 when the atlas is a file of its own
  std::size_t total_bytes = 0;      ///< a multiple of 4
};

/// In: the product; whether each copy is a part of its own; size of the PNG to embed, 0 for none.
[[nodiscard]] Layout make_layout(const driver::Product& product, bool part_per_copy, std::size_t atlas_bytes);

/// Appends the chunk's geometry (all but the atlas) to `out`: positions (x, y, z) become (x, z, −y), glTF's y-up.
void append_geometry(const driver::Product& product, const Layout& layout, std::string& out);

}  // namespace orbc::gltf
