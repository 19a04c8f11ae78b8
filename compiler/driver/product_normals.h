#pragma once
#include "compiler/base/executor.h"
#include "compiler/driver/product.h"

namespace orbc::driver {

/// Gives a product normals for renderers that light it by themselves: smooth within a copy, apart where triangles meet at more than the
/// crease angle of light::part_normals; vertices are doubled there.
void add_normals(Product& product, const Executor& executor);

}  // namespace orbc::driver
