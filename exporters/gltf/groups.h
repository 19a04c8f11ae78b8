#pragma once
#include <string>
#include <vector>

#include "compiler/driver/product.h"
#include "exporters/gltf/layout.h"

namespace orbc::gltf {

/// Parts that stand in one mesh, under one name.
struct Group {
  std::string name;
  std::size_t first_part = 0, part_count = 0, copies = 0;
};

/// One group for all, or one an object. The parts of an object follow one another.
[[nodiscard]] std::vector<Group> groups_of(const driver::Product& product, const Layout& layout);

}  // namespace orbc::gltf
