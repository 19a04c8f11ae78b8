#pragma once
#include "compiler/base/executor.h"
#include "compiler/lod/lods.h"

namespace orbc::lod {

/// Simplifies the heavy objects of a room, once for all copies.
/// Makes: levels with about 2/5 of the triangles of the one before; their vertices are vertices of the part. Parts with few triangles have
///        no levels, nor have parts with textures, which would shift.
/// Error: `surface_offset` is measured at points a few edges of the part apart (build.cpp).
[[nodiscard]] InteriorWithLods build_lods(const place::Interior& room, const Executor& executor);

/// The room at full detail only.
[[nodiscard]] InteriorWithLods without_lods(const place::Interior& room);

}  // namespace orbc::lod
