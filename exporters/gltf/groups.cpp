#include "exporters/gltf/groups.h"

namespace orbc::gltf {

std::vector<Group> groups_of(const driver::Product& product, const Layout& layout) {
  std::vector<Group> groups;
  for (std::size_t p = 0; p < layout.parts.size(); ++p) {
    const Part& part = layout.parts[p];
    if (groups.empty() || part.object != layout.parts[p - 1].object)
      groups.push_back({part.object ? product.objects[*part.object] : "copies", p, 0, 0});
    ++groups.back().part_count;
    groups.back().copies += part.copy_count;
  }
  return groups;
}

}  // namespace orbc::gltf
