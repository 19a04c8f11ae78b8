#pragma once
#include "compiler/driver/product.h"

namespace orbc::driver {

/// Makes the triangles whose texels are dimmed already entries of their own, with the weight 1.
/// In:    a product without native lights, in which no dimmed triangle shares a vertex with another; texels from `first_dimmed_v` on are
///        dimmed.
/// Makes: the same triangles. The new entries of an object follow its other entries.
[[nodiscard]] Product split_dimmed_triangles(Product product, double first_dimmed_v);

}  // namespace orbc::driver
