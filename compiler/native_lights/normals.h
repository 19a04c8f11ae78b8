#pragma once
#include <array>
#include <vector>

#include "compiler/base/executor.h"
#include "compiler/bend/bend.h"

namespace orbc::native_lights {

/// Bent copies with normals.
struct CoverWithNormals {
  bend::BentCover cover;
  std::vector<std::array<float, 3>> normals;  ///< unit, parallel to cover.positions
};

/// Gives bent copies the normals by which renderers light them: smooth within a copy, apart where triangles meet at more than the crease
/// angle of surface::part_normals. Vertices with several normals are repeated.
[[nodiscard]] CoverWithNormals with_normals(bend::BentCover cover, const Executor& executor);

}  // namespace orbc::native_lights
