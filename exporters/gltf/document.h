#pragma once
#include <string>

#include "compiler/driver/product.h"
#include "exporters/gltf/layout.h"
#include "exporters/gltf/write_gltf.h"

namespace orbc::gltf {

/// The names of the files beside a .gltf; empty: in the GLB, or not there.
struct Uris {
  std::string bin, atlas;
};

/// The JSON of a glTF: scene, nodes, camera, lamps, meshes, materials, accessors and buffers.
[[nodiscard]] std::string make_json(const driver::Product& product, const Layout& layout, const GltfOptions& options, const Uris& uris);

}  // namespace orbc::gltf
