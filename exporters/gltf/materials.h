#pragma once
#include <string>
#include <vector>

#include "compiler/driver/product.h"
#include "exporters/gltf/groups.h"
#include "exporters/gltf/json.h"
#include "exporters/gltf/layout.h"

namespace orbc::gltf {

/// The distinct materials, in order of first use, and which one each part has. A joint mesh has its weights per vertex.
struct MaterialTable {
  struct Material {
    scene::Color color{1, 1, 1};
    bool glows = true;
    std::string name = "atlas";
  };
  std::vector<Material> materials;
  std::vector<std::size_t> of_part;
};
[[nodiscard]] MaterialTable collect_materials(const driver::Product& product, const Layout& layout, bool per_copy,
                                              const std::vector<Group>& groups);

/// The number of the material of a group, if there is one a group: for parts that glow, and, where lamps light the others, for those.
[[nodiscard]] inline std::size_t material_of_group(std::size_t group, bool native, bool glows) {
  return native ? 2 * group + (glows ? 0 : 1) : group;
}

/// The atlas as materials refer to it.
struct AtlasReference {
  std::string uri;            ///< of its file; empty: it is in the GLB
  bool interpolated = false;  ///< between texels
  bool masked = false;        ///< there is no surface where its alpha is below one half
};

/// Writes the member `materials` and, for layouts with uv, `textures`, `samplers` and `images`.
void write_materials(Json& json, const Layout& layout, const MaterialTable& table, const AtlasReference& atlas);

}  // namespace orbc::gltf
