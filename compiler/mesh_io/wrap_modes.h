#pragma once
#include <vector>

#include "compiler/mesh/mesh.h"

namespace orbc::mesh_io {

/// How a picture goes on outside of [0, 1].
enum class Wrap { repeat, clamp, mirror };

/// The modes of a material's texture along u and v.
struct WrapModes {
  Wrap u = Wrap::repeat, v = Wrap::repeat;
};

/// Turns clamped and mirrored textures into repeated ones.
/// In:     per material its modes; materials behind the end of the list repeat.
/// Makes:  triangles cut where the picture begins and ends, or turns, with uv inside one repeat. A clamped texture is looked up half a
/// texel
///         inside its border. Triangles over more than a thousand repeats stay as they are.
[[nodiscard]] mesh::Mesh apply_wrap_modes(mesh::Mesh mesh, const std::vector<WrapModes>& modes);

}  // namespace orbc::mesh_io
