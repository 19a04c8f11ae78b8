#pragma once
#include <vector>

#include "compiler/mesh/mesh.h"

namespace orbc::mesh_io {

/// The value that stands for full light in a file that does not say: 1 when no channel is larger, else 255, else 65535.
[[nodiscard]] float white_of(const std::vector<mesh::LinearColor>& encoded);

/// Linear colours from sRGB-encoded ones. In: the value that stands for full light.
[[nodiscard]] std::vector<mesh::LinearColor> decode_colors(std::vector<mesh::LinearColor> encoded, float white);

/// Makes colours of materials out of those of vertices where every triangle has one colour, as faces with colours have; unless there are
/// thousands of them.
[[nodiscard]] mesh::Mesh fold_uniform_colors(mesh::Mesh mesh);

}  // namespace orbc::mesh_io
