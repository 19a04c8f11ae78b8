#pragma once
#include <functional>
#include <string>

#include "compiler/base/result.h"
#include "compiler/mesh/mesh.h"

namespace orbc::mesh {

/// Where the meshes and pictures come from that a scene names: files on a disk, or whatever a page or a test holds in memory.
struct AssetSource {
  std::function<Result<LoadedMesh>(const std::string& path)> load_mesh;
  std::function<Result<image::Image>(const std::string& path)> load_image;
};

/// A source without assets: every path is refused with mesh.missing-file.
[[nodiscard]] AssetSource no_assets();

}  // namespace orbc::mesh
