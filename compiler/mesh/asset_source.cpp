#include "compiler/mesh/asset_source.h"

namespace orbc::mesh {

AssetSource no_assets() {
  const auto refuse = [](const std::string& path) { return make_error("mesh.missing-file", path + ": no files are read here"); };
  return {[refuse](const std::string& path) -> Result<LoadedMesh> { return refuse(path); },
          [refuse](const std::string& path) -> Result<image::Image> { return refuse(path); }};
}

}  // namespace orbc::mesh
